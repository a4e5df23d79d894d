"""Manifold's Minkowski sum of two OFF files of triangles: prints milliseconds, volume and components.

manifold_sum.py P.off Q.off [--guard]: with the guard both operands are moved until the origin lies inside; without it
Manifold's answers are wrong where it does not."""
import sys
import time

import manifold3d
import numpy


def read(path):
    words = open(path).read().split()[1:]
    vertices, faces = int(words[0]), int(words[1])
    at = 3
    points = numpy.array(words[at:at + 3 * vertices], dtype=numpy.float64).reshape(-1, 3)
    at += 3 * vertices
    triangles = numpy.array(words[at:at + 4 * faces], dtype=numpy.int64).reshape(-1, 4)[:, 1:]
    return points, triangles


def inside(points, triangles):
    """A point a little below the largest triangle."""
    a, b, c = (points[triangles[:, k]] for k in range(3))
    normals = numpy.cross(b - a, c - a)
    largest = numpy.argmax(numpy.linalg.norm(normals, axis=1))
    normal = normals[largest] / numpy.linalg.norm(normals[largest])
    depth = 1e-3 * numpy.max(points.max(axis=0) - points.min(axis=0))
    return (a + b + c)[largest] / 3 - depth * normal


def solid(path, guard):
    points, triangles = read(path)
    if guard:
        points = points - inside(points, triangles)
    mesh = manifold3d.Mesh64(vert_properties=points, tri_verts=triangles.astype(numpy.uint64))
    return manifold3d.Manifold(mesh)


guard = "--guard" in sys.argv
p, q = (solid(path, guard) for path in sys.argv[1:3])
start = time.process_time()
total = p.minkowski_sum(q)
volume = total.volume()
print((time.process_time() - start) * 1e3, repr(volume), len(total.decompose()))
