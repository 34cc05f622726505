"""The colour of a part of a mesh: of its material, its texture, or its corners."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from robotics1.inputs import Array
from robotics1.robot.visuals import Color

IMAGES = ("PNG", "JPEG", "BMP", "TGA", "TIFF", "WEBP", "GIF")
MOST_PIXELS = 70_000_000
INVISIBLE = 0.02  # opacity below which a file means something else: conventions differ, and nobody draws what is unseen


def color_of(geometry: Mapping[str, Any], means: dict[int, Array | None], *, linear: bool) -> Color | None:
    """Return the colour of a geometry that trimesh has read, or None; `means` keeps those of images by their id."""
    material = getattr(geometry.get("visual"), "material", None)
    corners = geometry.get("vertex_colors")
    image = None
    if material is not None:
        color, image = _material(material)
    elif corners is not None and len(corners) and np.ndim(corners) == 2:
        color = _fractions(corners).mean(axis=0)
    else:
        return None
    if linear:
        color = np.r_[_to_screen(color[:3]), color[3]]
    if image is not None:
        if id(image) not in means:
            means[id(image)] = image_mean(image)
        mean = means[id(image)]
        color = color if mean is None else color * np.r_[mean, 1.0]
    return screen_color(color)


def screen_color(color: Array) -> Color | None:
    """Return a colour (4,) as numbers from 0 to 1 in steps of 1/255, or None where it has none."""
    if np.shape(color) != (4,) or not np.isfinite(color).all():
        return None
    red, green, blue, opacity = (round(round(255 * float(value)) / 255, 4) for value in np.clip(color, 0, 1))
    return red, green, blue, opacity if opacity > INVISIBLE else 1.0


def image_mean(image: Any) -> Array | None:
    """Return the mean colour (3,) of a PIL image, None where it is too large or cannot be read."""
    from PIL import Image

    if image.format not in IMAGES or image.width * image.height > MOST_PIXELS:
        return None
    try:
        image.draft("RGB", (64, 64))
        small = image.convert("RGB").resize((1, 1), Image.Resampling.BOX)
    except Exception:  # PIL raises many kinds for broken images
        return None
    return np.array(small.getpixel((0, 0))) / 255


def _material(material: Any) -> tuple[Array, Any]:
    """Return the factor and the image of a material of glTF, or of OBJ."""
    if not hasattr(material, "baseColorFactor"):
        return np.r_[_fractions(material.diffuse)[:3], _opacity(material.kwargs)], material.image
    factor = material.baseColorFactor
    return np.ones(4) if factor is None else _fractions(factor), material.baseColorTexture


def _opacity(of_obj: Mapping[str, Any]) -> float:
    """Return the opacity of a material of OBJ, which says `d 0.5` or `Tr 0.5`."""
    try:
        if "d" in of_obj:
            return float(of_obj["d"][-1])
        return 1 - float(of_obj["tr"][-1]) if "tr" in of_obj else 1.0
    except (TypeError, ValueError, IndexError):
        return 1.0


def _fractions(color: Any) -> Array:
    """Return colours (..., 4) from 0 to 1."""
    given = np.asarray(color)
    values = given / np.iinfo(given.dtype).max if np.issubdtype(given.dtype, np.integer) else given.astype(float)
    return values if values.shape[-1] == 4 else np.concatenate([values, np.ones((*values.shape[:-1], 1))], axis=-1)


def _to_screen(light: Array) -> Array:
    """Return colours for the screen from amounts of light, as IEC 61966-2-1 (sRGB) defines them."""
    return np.where(light <= 0.0031308, 12.92 * light, 1.055 * np.maximum(light, 0.0031308) ** (1 / 2.4) - 0.055)
