#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# Run the cases and make all pictures of the documentation, doc/figures/*.png
# and *.svg.
#
#   doc/figures/make.sh [TALUS [SCRATCH]]
#
# TALUS is the program (default build/release/talus), SCRATCH the folder for
# the results (default build/figures, about 1 GB). Takes half an hour, most of it
# the slope in 3-D. A case whose folder is there is not run again: remove the
# folder to repeat it.
#
# Needs Debian's package python3-matplotlib.
set -eu

cd "$(dirname "$0")/../.."
talus=${1:-build/release/talus}
scratch=${2:-build/figures}
here=doc/figures

# run NAME FILE OPTIONS...: NAME.part becomes NAME when the run has ended well.
run() {
  name=$1
  file=$2
  shift 2
  [ -d "$scratch/$name" ] && return
  rm -rf "$scratch/$name.part"
  "$talus" "$file" --output "$scratch/$name.part" \
    --set "Output/Write grid=false" "$@"
  mv "$scratch/$name.part" "$scratch/$name"
}

mkdir -p "$scratch"
run landslide prm/landslide-quick.prm --set "Splitting/Directions=stretched" --set "Splitting/Shear=ignored" \
    --set "Output/Field interval=5"
run landslide-unsplit prm/landslide-quick.prm --set "Splitting/Enabled=false" \
    --set "Output/Field interval=5"
run pipeline prm/pipeline.prm
run pipe-on-springs prm/pipe-on-springs.prm
for stress in 0 1e3; do
  run pipe-$stress prm/verification/pipe.prm --set "Grid/Cell size=0.0625" \
      --set "Obstacles/pipe/Maximum shear stress=$stress" \
      --set "Output/Boxes as cells=true" --set "Output/Field interval=10"
done
run slab-failure prm/slab-failure.prm
run sand-slope prm/sand-slope.prm
run sediment-slope prm/sediment-slope.prm
run slope prm/slope.prm
run slope-3d prm/slope-3d.prm
run first-slope prm/first-slope.prm --set "Output/Boxes as cells=true" \
    --set "Output/Field interval=5"
run bar prm/bar.prm --set "Output/Boxes as cells=true" \
    --set "Output/Field interval=0.5"
run bar-unsplit prm/bar.prm --set "Splitting/Enabled=false" \
    --set "Output/Write points=false"
static='equilibrium, strength reduction'
run safety-cut prm/verification/vertical-cut.prm --set "Stages=$static" \
    --set "Gravity/Magnitude=2" --set "Gravity/Ramp time=0" \
    --set "Damping/Local damping=0" --set "Output/Boxes as cells=false" \
    --set "Strength reduction/First factor=1.9"
run safety-landslide prm/landslide-trigger.prm --set "Stages=$static" \
    --set "Output/Boxes as cells=false" \
    --set "Strength reduction/First factor=3.7"

run syrup prm/validation/syrup-dam-break.prm
run syrup-channel prm/validation/syrup-channel.prm
run beads prm/validation/bead-dam-break.prm
run spreading prm/validation/viscous-spreading.prm
run gum prm/validation/xanthan-gum.prm
strength='Undrained shear strength'
for stress in 0.05 0.10 0.20; do # over rho g H = 1471.5 Pa
  for base in fixed roller; do
    run cylinder-$base-$stress prm/validation/cylinder-slump.prm \
        --set "Boundaries/Bottom=$base" \
        --set "Materials/clay/$strength=$(echo "$stress * 1471.5" | bc)"
  done
done
for stress in 500 1000 1500; do
  run cone-$stress prm/validation/abrams-cone.prm \
      --set "Materials/concrete/$strength=$stress"
done

draw() {
  script=$1
  shift
  /usr/bin/python3 "$here/$script.py" "$@"
}
draw concepts $here
rm -rf "$scratch/new-case"
share/talus/talus-new prm/data/gully.asc prm/data/release.geojson 15 --output "$scratch/new-case"
cp "$scratch/new-case/release.png" $here/new-case.png
draw bar $here/bar.png $scratch/bar $scratch/bar-unsplit
draw landslide $scratch/landslide $here/landslide.png
draw landslide $scratch/first-slope $here/first-slope.png
draw pipeline $here/pipeline.png $scratch/pipeline
draw moving_obstacles $here/moving-obstacles.png $scratch/pipe-on-springs
draw slab_failure $here/slab-failure.png $scratch/slab-failure
draw sand_slope $here/sand-slope.png $scratch/sand-slope
draw sediment_slope $here/sediment-slope.png $scratch/sediment-slope
draw slope $here/slope.png $scratch/slope-3d $scratch/slope
draw pipe_flow $here/pipe-flow.png \
          $scratch/pipe-0=smooth $scratch/pipe-1e3=rough
draw validation $here/validation.png $scratch
for tool in study calibrate; do
  share/talus/talus-$tool share/talus/gypsum-study.prm --program "$talus" \
      --output "$scratch/gypsum-study"
done
cp "$scratch/gypsum-study/calibration.png" $here/gypsum-calibration.png
draw toe $here/toe.png $scratch/landslide-unsplit \
          $scratch/landslide
draw mechanism $here/mechanism.png \
          "$scratch/safety-cut=Vertical cut in clay" \
          "$scratch/safety-landslide=The landslide before it is let go"
draw runout $here/runout.png \
  "$scratch/landslide=with splitting" \
  "$scratch/landslide-unsplit=without splitting"
