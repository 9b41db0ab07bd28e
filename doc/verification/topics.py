# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pages of the verification, and what kind of evidence each row is.

PAGES lists, per page, the capabilities in the order of the page, and below each
capability the test suites of ctest's label `verification` that hold it. A new suite
needs an entry here.
"""

import re

# (file, title, [(capability, [suite, ...]), ...])
PAGES = [
    ("scheme", "Transfer, convergence and elasticity", [
        ("Bar of the paper", ["Bar", "BarConvergence"]),
        ("Manufactured solutions",
         ["ManufacturedBar", "Manufactured2d", "Manufactured3d", "Vortex",
          "ExpandingRing"]),
        ("Elasticity at large strain",
         ["Discs", "SelfWeightColumn", "ElasticaLoads", "Elastica"]),
        ("Convected domains", ["Cantilever", "HangingCube"]),
    ]),
    ("strength", "Strength and flow", [
        ("Strength at one point", ["OnePoint"]),
        ("Layers on a slope", ["ShearLayer", "ViscoplasticLayer"]),
        ("Vertical cut", ["VerticalCut", "VerticalCutBracket"]),
    ]),
    ("contact", "Seabed, obstacles and water", [
        ("Seabed", ["Block", "Channel"]),
        ("Thin layers", ["ThinLayers"]),
        ("Obstacles", ["BlockOnPlane", "Arc", "Container", "Bowl",
                       "Symmetry", "RollingDisc"]),
        ("Pipes in clay", ["Pipe", "PipeRefined"]),
        ("Obstacles moved by forces", ["BodyOnSprings", "DraggedPipe"]),
        ("Water", ["BlockInWater", "SheetInWater"]),
        ("Runout, rest and outflow",
         ["Runout", "Rest", "Inflow", "FedLayer", "Outflow"]),
    ]),
    ("statics", "Equilibrium and factor of safety", [
        ("Equilibrium",
         ["Multigrid"]),
        ("Factor of safety",
         ["InfiniteSlope", "TaylorSlope", "FrictionalSlope", "PaperSlopeSafety",
          "ClaySlope", "ClaySlopeFine", "SlopeStability", "StripFooting",
          "StripFootingFine", "VerticalCutSafety", "VerticalCutSafetyFine"]),
        ("Shear bands", ["ShearBand", "ShearBandFine", "ShearBandRuns",
                         "SlabFailure", "SofteningSeabed"]),
        ("Retrogression in sensitive clay", ["Retrogression"]),
        ("Excess pore pressure", ["PorePressure", "SandSlope", "CamClay"]),
        ("Initial stress, trigger and ground motion",
         ["Geostatic", "Trigger", "GroundMotion", "LandslideFromEquilibrium",
          "LandslideFromEquilibriumFine"]),
    ]),
    ("landslide", "The landslide of the paper", [
        ("Landslide to rest",
         ["LandslideFull", "LandslideFullUnsplit", "LandslideFourWay",
          "LandslideStretched", "LandslideCoarse", "LandslideUnsplit",
          "LandslideSimilarity",
          "LandslideOfLayers", "LandslideUndrained", "Landslide3d"]),
        ("Numerical fracture and thin slides", ["HangingBlock", "ThinSlide"]),
        ("Merging", ["LandslideMerged"]),
        ("Shear and stretch",
         ["ThrownDisc", "SlabFailureLattice", "SlopeLattice",
          "LandslideLattice"]),
        ("Filter and boxes", ["QuietPoints", "Boxes"]),
        ("Landslide on an obstacle",
         ["LandslideInclined", "LandslideInclined3d", "LandslideInclinedFull",
          "LandslideInclinedFine"]),
    ]),
    ("laboratory", "Laboratory experiments", [
        ("Dam breaks", ["SyrupDamBreak", "SyrupDamBreakFine", "SyrupChannel",
                        "BeadDamBreak", "BeadDamBreakFine"]),
        ("Spreading and slumps",
         ["ViscousSpreading", "ViscousSpreadingFine", "XanthanGum",
          "XanthanGumFine", "CylinderSlump", "CylinderSlumpFine",
          "AbramsCone", "AbramsConeFine"]),
    ]),
]

# Kinds of evidence: name, heading of the column of the matrix, explanation.
KINDS = [
    ("reference", "reference",
     "a closed form, a published value or an independent computation"),
    ("order", "order",
     "order of convergence, or growth of the work under refinement"),
    ("balance", "balance",
     "a conservation law, or the continuity of the body"),
    ("agreement", "agreement",
     "two computations of talus that must agree: other cells, another "
     "direction, two or three dimensions"),
    ("baseline", "baseline",
     "values of talus itself: the gate notices a change and says nothing about "
     "accuracy"),
]

# (kind, suites, text in `case | quantity | source`); the first that matches. A
# row without a match is compared with a reference.
RULES = [
    ("order", "", r"order of|growth per halving|residuals of one load step"),
    ("baseline", "Boxes", ""),
    ("balance", "Bowl", r"height"),
    ("baseline", "Discs", r"speed towards each other"),
    ("baseline", "", r"at rest from|highest point at rest|unsplit: |"
     r"points at rest|splits / splits|speed of points|scatter of the mean|"
     r"largest stretch|mean thickness|3 generations|\| without: |merging work"),
    ("balance", "", r"energy (drift|lost|created|gained|remainder)|conservation error|"
     r"mass inside|empty interior|empty columns|bodies|work of the loads|"
     r"mass below|seabed force over|kinetic energy before"),
    ("agreement", "LandslideFromEquilibrium", r"\| front"),
    ("reference", "Trigger|Inflow|Outflow", ""),
    ("balance", "", r"momentum"),
    ("agreement", "LandslideInclined|LandslideSimilarity|LandslideOfLayers|"
     "LandslideMerged|Landslide3d|QuietPoints|PaperSlopeSafety|SlabFailure|"
     "Retrogression", ""),
    ("agreement", "", r"the same pipe|to the right|no splits|against T/6|"
     r"well-balanced load|after equilibrium with|difference to \d+ s"),
]


def kind_of(suite, row):
    """Kind of evidence of a row, by name."""
    text = " | ".join((row["case"], row["quantity"], row["source"]))
    for kind, suites, pattern in RULES:
        if re.match(suites, suite) and re.search(pattern, text):
            return kind
    return "reference"


def page_of():
    """File of the page by suite."""
    return {suite: page for page, _, sections in PAGES
            for _, suites in sections for suite in suites}
