"""A decal around a point:  pvbatch decal.py

An image lies on a bath toy around a point of its wing, with little distortion: the texture coordinates of Parallel Transport. What lies at
the rim of the image goes on over the rest of the surface.
"""

import numpy as np
from scene import *
import surfaces


def sun(size=512):
    """A sun with a face, on ivory; its rim is ivory, as what lies at the rim of an image goes on beyond."""
    y, x = np.mgrid[-1:1:size * 1j, -1:1:size * 1j]
    radius, angle = np.hypot(x, y), np.arctan2(y, x)
    image = np.full((size, size, 3), np.array(IVORY) * 255)
    image[radius < 0.68 + 0.24 * np.cos(12 * angle)] = np.array(RED) * 255
    image[radius < 0.55] = np.array(GOLD) * 255
    eyes = np.minimum(np.hypot(x - 0.2, y - 0.15), np.hypot(x + 0.2, y - 0.15)) < 0.06
    smile = (np.abs(radius - 0.33) < 0.035) & (y < -0.12)
    image[eyes | smile] = np.array(BLUE) * 255
    return image


def main():
    carried = ParallelTransport(Input=surfaces.source(surfaces.duck(0.03)), Point=[-0.1, 0.05, 0.9], Direction=[1, 0, 0], TextureSize=1.1)
    view = view_from([0.1, 0.2, 1], [900, 720])
    display = show_surface(carried, view, [1, 1, 1])
    display.Texture, display.RepeatTextures = texture_of(sun()), 0
    save(view, "decal", 1.3)
    return carried


if __name__ == "__main__":
    main()
