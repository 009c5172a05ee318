"""Evenly spaced lines along a field of N directions on a triangle surface.

Each line follows one of the N directions, from face to face the one that turns least, and ends where
it comes too close to a line that runs the same way (B. Jobard and W. Lefer, Creating evenly-spaced
streamlines of arbitrary density, 1997). Lines of different directions cross.
"""

import math
import random

import numpy as np


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def along(point, direction, length):
    return tuple(point[i] + length * direction[i] for i in range(3))


class Surface:
    """What tracing needs of each face, as plain lists, which Python reads faster than arrays.

    points      #V by 3
    triangles   #F by 3
    directions  N arrays, each #F by 3, unit vectors
    """

    def __init__(self, points, triangles, directions):
        corners = points[triangles]
        sides = np.roll(corners, -1, axis=1) - corners
        normals = np.cross(sides[:, 0], sides[:, 1])
        normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
        sides /= np.maximum(np.linalg.norm(sides, axis=2, keepdims=True), 1e-300)
        outward = np.cross(sides, normals[:, None, :])

        # The face on the other side of each side of each face, -1 at the boundary.
        ends = np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=2).reshape(-1, 2)
        key = ends.min(axis=1) * len(points) + ends.max(axis=1)
        order = np.argsort(key, kind="stable")
        pairs = np.flatnonzero(key[order[:-1]] == key[order[1:]])
        neighbours = np.full(len(key), -1)
        neighbours[order[pairs]] = order[pairs + 1]
        neighbours[order[pairs + 1]] = order[pairs]

        self.centres = list(map(tuple, corners.mean(axis=1)))
        self.corners = [[tuple(corner) for corner in face] for face in corners.tolist()]
        self.sides = [[tuple(side) for side in face] for face in sides.tolist()]
        self.outward = [[tuple(normal) for normal in face] for face in outward.tolist()]
        self.normals = list(map(tuple, normals.tolist()))
        self.neighbours = neighbours.reshape(-1, 3).tolist()  # as 3 face + side
        self.directions = [[tuple(d) for d in face]
                           for face in np.stack(directions, axis=1).tolist()]

    def leave(self, face, point, direction):
        """Where a ray leaves its face: length, side."""
        best, side = math.inf, 0
        for i in range(3):
            speed = dot(direction, self.outward[face][i])
            if speed > 1e-12:
                corner = self.corners[face][i]
                way = (corner[0] - point[0], corner[1] - point[1], corner[2] - point[2])
                length = max(0.0, dot(way, self.outward[face][i]) / speed)
                if length < best:
                    best, side = length, i
        return best, side

    def unfold(self, face, side, direction):
        """The face behind a side and the same direction there, unfolded; None at the boundary."""
        other = self.neighbours[face][side]
        if other < 0:
            return None
        behind, back = divmod(other, 3)
        # What points along the side, or outwards, here points against it, or inwards, there.
        a = dot(direction, self.sides[face][side])
        b = dot(direction, self.outward[face][side])
        there, inwards = self.sides[behind][back], self.outward[behind][back]
        return behind, tuple(-a * there[k] - b * inwards[k] for k in range(3))

    def nearest(self, face, direction):
        """The direction of the field in a face that turns least from the given one."""
        return max(self.directions[face], key=lambda d: dot(d, direction))

    def beside(self, face, point, direction, distance):
        """The place at a distance to the left of a direction: face, point, direction; or None."""
        normal = self.normals[face]
        way = (normal[1] * direction[2] - normal[2] * direction[1],
               normal[2] * direction[0] - normal[0] * direction[2],
               normal[0] * direction[1] - normal[1] * direction[0])
        for _ in range(100):
            length, side = self.leave(face, point, way)
            if length >= distance:
                return face, along(point, way, distance), self.nearest(face, direction)
            point, distance = along(point, way, length), distance - length
            step, turned = self.unfold(face, side, way), self.unfold(face, side, direction)
            if not step:
                return None
            (face, way), direction = step, turned[1]
        return None


class Lines:
    """The lines drawn so far; their samples stand in a grid whose cells are as wide as the distance
    between lines."""

    def __init__(self, surface, distance):
        self.surface = surface
        self.distance = distance
        self.cells = {}
        self.lines = []

    def cell(self, point):
        return tuple(int(math.floor(x / self.distance)) for x in point)

    def is_free(self, face, point, direction, distance, line=None):
        """Whether no line near runs the same way; samples marked with the given line do not count."""
        normal = self.surface.normals[face]
        x, y, z = self.cell(point)
        for i in (x - 1, x, x + 1):
            for j in (y - 1, y, y + 1):
                for k in (z - 1, z, z + 1):
                    for other, way, side, owner in self.cells.get((i, j, k), ()):
                        gap = (point[0] - other[0], point[1] - other[1], point[2] - other[2])
                        if (dot(gap, gap) < distance * distance and owner != line
                                and abs(dot(direction, way)) > 0.7 and dot(normal, side) > 0):
                            return False
        return True

    def add(self, face, point, direction, owner):
        cell = self.cells.setdefault(self.cell(point), [])
        cell.append((point, direction, self.surface.normals[face], owner))
        return cell

    def half(self, face, point, direction, line, cells):
        """One half of a line: points, normals and samples (face, point, direction)."""
        surface = self.surface
        points, normals = [point], [surface.normals[face]]
        samples, recent = [(face, point, direction)], []
        since, steps = 0.0, 0
        while steps < 300:  # else the line gets nowhere: directions that point to the same side
            length, side = surface.leave(face, point, direction)
            if not math.isfinite(length):
                break
            point = along(point, direction, length)
            since += length
            steps += 1
            points.append(point)
            normals.append(surface.normals[face])
            if since > 0.4 * self.distance:
                since, steps = 0.0, 0
                if not self.is_free(face, point, direction, 0.6 * self.distance, line):
                    break
                # A line may end on itself, but not on the samples just drawn, nor on those around
                # its start, where its other half begins.
                if len(samples) <= 8:
                    cells.append(self.add(face, point, direction, line))
                else:
                    recent.append((face, point, direction))
                if len(recent) > 8:
                    cells.append(self.add(*recent.pop(0), None))
                samples.append((face, point, direction))
            step = surface.unfold(face, side, direction)
            if not step:
                break
            face, direction = step[0], surface.nearest(*step)
        for sample in recent:
            cells.append(self.add(*sample, line))
        return points, normals, samples

    def draw(self, face, point, direction):
        """A line through a point, unless it is short; its samples."""
        line = len(self.lines) + 1
        cells = [self.add(face, point, direction, line)]
        there = self.half(face, point, direction, line, cells)
        back = self.half(face, point, tuple(-x for x in direction), line, cells)
        samples = back[2] + there[2]
        if len(samples) < 14:
            for cell in cells:
                cell.pop()
            return []
        self.lines.append((back[0][:0:-1] + there[0], back[1][:0:-1] + there[1]))
        return samples

    def fill(self, face, point, direction):
        """A line through a point, lines beside it, and so on."""
        waiting = [(face, point, direction)]
        while waiting:
            start = waiting.pop(0)
            if not self.is_free(*start, 0.95 * self.distance):
                continue
            for face, point, direction in self.draw(*start)[::3]:
                for way in (direction, tuple(-x for x in direction)):
                    place = self.surface.beside(face, point, way, self.distance)
                    if place and dot(place[2], place[2]) > 0.5:
                        waiting.append(place)


def evenly_spaced_lines(points, triangles, directions, distance, seed=2026):
    """Lists of points and of normals, one pair per line.

    points      #V by 3
    triangles   #F by 3
    directions  N arrays, each #F by 3, unit vectors or zero
    distance    between lines that run the same way, in the units of the points
    """
    surface = Surface(np.asarray(points, float), np.asarray(triangles), directions)
    lines = Lines(surface, distance)
    faces = list(range(len(triangles)))
    random.Random(seed).shuffle(faces)
    for face in faces[:5000]:
        for direction in surface.directions[face][:max(1, len(directions) // 2)]:
            if dot(direction, direction) > 0.5:
                lines.fill(face, surface.centres[face], direction)
    return lines.lines
