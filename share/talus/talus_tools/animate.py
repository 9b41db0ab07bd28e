# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command line of talus-animate: the pictures of the report's slider as a film."""

import io
import os
import shutil
import subprocess

import numpy
from matplotlib.font_manager import findfont
from PIL import Image, ImageDraw, ImageFont

from talus_tools.errors import Parser, UserError
from talus_tools.report.film import film
from talus_tools.report.run import Run
from talus_tools.texts import shown

DESCRIPTION = """Make a film of a run of talus: thickness and speed from above in 3-D, the soil in
section in 2-D, one picture per time of its fields ('Output/Field interval'). A film needs ffmpeg
if its name ends with .mp4; for .gif nothing more is needed."""
OPACITY = 0.88  # of the soil over the bathymetry, as on the page
GIF_WIDTH = 900  # pixels
HEAD = 44  # pixels for title and time


def parse():
    """Options."""
    parser = Parser(prog="talus-animate", description=DESCRIPTION)
    parser.add_argument("folder", metavar="DIR", help="output folder of a run")
    parser.add_argument("--output", metavar="FILE", help="film, .mp4 or .gif; by default "
                        "animation.mp4 in DIR, or animation.gif where there is no ffmpeg")
    parser.add_argument("--fps", metavar="N", type=float, default=8.0,
                        help="pictures per second (8)")
    parser.add_argument("--most", metavar="N", type=int, default=300,
                        help="take at most so many times, evenly (300)")
    options = parser.parse_args()
    if not 0.1 <= options.fps <= 60:
        raise UserError(f"--fps {options.fps:g} was given, where 0.1 to 60 pictures per second "
                        "were expected.")
    if options.most < 2:
        raise UserError(f"--most {options.most} was given, where at least 2 times were expected.")
    return options


def composed(view, frame):
    """The picture of a view at the time of a frame."""
    base = Image.open(io.BytesIO(view.base)).convert("RGBA")
    left, top, width, height = view.window
    corner = round(left * base.width), round(top * base.height)
    size = round(width * base.width), round(height * base.height)
    # Palette entry 0 is no soil.
    alpha = frame.point(lambda entry: round(255 * OPACITY) if entry else 0, mode="L")
    soil = frame.convert("RGBA")
    soil.putalpha(alpha)
    layer = Image.new("RGBA", base.size)
    layer.paste(soil.resize(size, Image.Resampling.NEAREST), corner)
    base.alpha_composite(layer)
    base.alpha_composite(Image.open(io.BytesIO(view.top)).convert("RGBA").resize(base.size))
    return base.convert("RGB")


def pictures(found, title):
    """One picture per time: title and time above all views. Even numbers of pixels, as films
    want them."""
    font = ImageFont.truetype(findfont("DejaVu Sans"), 22)
    for k, time in enumerate(found.times):
        parts = [composed(view, view.frames[k]) for view in found.views]
        width = 2 * (max(part.width for part in parts) // 2)
        height = 2 * ((HEAD + sum(part.height for part in parts)) // 2)
        result = Image.new("RGB", (width, height), "white")
        draw = ImageDraw.Draw(result)
        draw.text((16, 10), title, fill="#1d262d", font=font)
        text = f"t = {time:.4g} s"
        draw.text((width - 16 - draw.textlength(text, font=font), 10), text, fill="#1f5fa8",
                  font=font)
        y = HEAD
        for part in parts:
            result.paste(part, (0, y))
            y += part.height
        yield result


def common_palette(images):
    """One palette for all pictures, so that colours do not flicker: 64 shades of grey, and those
    of the scales. These take few pixels: each colour counts once, whatever its area."""
    pixels = numpy.concatenate([numpy.asarray(image).reshape(-1, 3) for image in images])
    colors = pixels[numpy.ptp(pixels, axis=1) >= 16]
    colors = numpy.unique(colors // 6, axis=0).astype(numpy.uint8) * 6 + 3
    greys = numpy.repeat(numpy.linspace(0, 255, 64).astype(numpy.uint8), 3)
    table = Image.fromarray(colors[None]).quantize(192, Image.Quantize.MEDIANCUT).getpalette(
        ) if len(colors) else []
    palette = Image.new("P", (1, 1))
    palette.putpalette([*greys.tolist(), *table[:3 * 192]])
    return palette


def write_gif(path, images, fps):
    """By Pillow; it repeats for ever, with a pause at the end."""
    shown = [image.resize((GIF_WIDTH, round(GIF_WIDTH * image.height / image.width)),
                          Image.Resampling.LANCZOS) for image in images]
    palette = common_palette(shown[::max(1, len(shown) // 4)])
    frames = [image.quantize(palette=palette, dither=Image.Dither.NONE) for image in shown]
    durations = [round(1000 / fps)] * (len(frames) - 1) + [max(1500, round(1000 / fps))]
    frames[0].save(path, "GIF", save_all=True, append_images=frames[1:], duration=durations,
                   loop=0, optimize=True)


def write_mp4(path, images, fps):
    """By ffmpeg, in a form that browsers and presentations show."""
    images = iter(images)
    first = next(images)
    command = ["ffmpeg", "-y", "-loglevel", "error", "-f", "rawvideo", "-pix_fmt", "rgb24",
               "-s", f"{first.width}x{first.height}", "-r", f"{fps:g}", "-i", "-",
               "-c:v", "libx264", "-pix_fmt", "yuv420p", "-crf", "20", "-movflags", "+faststart",
               "-f", "mp4", path]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stderr=subprocess.PIPE) as process:
        try:
            for image in (first, *images):
                process.stdin.write(image.tobytes())
        except BrokenPipeError:
            pass
        _, said = process.communicate()
    if process.returncode != 0:
        raise UserError(f"ffmpeg could not write '{path}': "
                        f"{said.decode(errors='replace').strip()[-200:]}. With '--output "
                        "FILE.gif' it is not needed.")


def path_of(options):
    """Where the film goes; its ending says what it is."""
    has_ffmpeg = shutil.which("ffmpeg") is not None
    path = options.output or os.path.join(options.folder,
                                          "animation." + ("mp4" if has_ffmpeg else "gif"))
    if not path.endswith((".mp4", ".gif")):
        raise UserError(f"--output '{path}' was given, where a name that ends with .mp4 or .gif "
                        "was expected.")
    if path.endswith(".mp4") and not has_ffmpeg:
        raise UserError(f"'{path}' needs the program ffmpeg, which was not found. Install Debian's "
                        "package ffmpeg, or give a name that ends with .gif.")
    return path


def main():
    """Write the film; it gets its name when it is complete."""
    options = parse()
    run, path = Run(options.folder), path_of(options)
    found = film(run, options.most)
    if found is None:
        raise UserError(f"'{options.folder}' has no fields at two times or more, of which a film "
                        "could be made: neither points ('Output/Write points') nor, in 3-D, "
                        "profile.csv ('Output/Runout').")
    title = run.title or shown(os.path.basename(os.path.abspath(options.folder)))
    write = write_gif if path.endswith(".gif") else write_mp4
    try:
        write(path + ".part", list(pictures(found, title)), options.fps)
        os.replace(path + ".part", path)
    except OSError as error:
        raise UserError(f"'{path}' cannot be written: {error.strerror}.") from error
    print(f"{len(found.times)} pictures are in {path}.")
    return 0
