"""Makes the animation of Race in docs/pictures of the frames that `npm run screenshots` has taken. Needs Pillow."""

import tempfile
from pathlib import Path

from PIL import Image

HERE = Path(__file__).parent
FRAME_MS = 110
LAST_MS = 1500
COLORS = 96

frames = [Image.open(path).convert("RGB") for path in sorted((Path(tempfile.gettempdir()) / "starl-frames").glob("*.png"))]
# One palette, of a frame in which every robot has moved, so that nothing flickers.
palette = frames[len(frames) * 2 // 3].quantize(COLORS, method=Image.Quantize.MEDIANCUT)
drawn = [frame.quantize(palette=palette, dither=Image.Dither.NONE) for frame in frames]
target = HERE.parent.parent / "docs" / "pictures" / "race.gif"
durations = [FRAME_MS] * (len(drawn) - 1) + [LAST_MS]
drawn[0].save(target, save_all=True, append_images=drawn[1:], duration=durations, loop=0, optimize=True)
print(target.name, target.stat().st_size, "bytes")
