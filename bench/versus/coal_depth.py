"""Coal's penetration depths of two convex solids.

coal_depth.py P.off Q.off QUERIES TOLERANCE: a line of QUERIES is P's matrix, row by row, and the translation of Q. Prints
the version, the microseconds of all calls by Coal's own clock (least of three rounds), and a depth per query, 0 where
they are apart. TOLERANCE 0 leaves Coal's settings as they are."""
import sys

import coal
import numpy


def solid(path):
    words = open(path).read().split()[1:]
    count = int(words[0])
    points = coal.StdVec_Vec3s()
    for point in numpy.array(words[3:3 + 3 * count], dtype=numpy.float64).reshape(-1, 3):
        points.append(point)
    return coal.Convex.convexHull(points, True, "Qt")


p, q = solid(sys.argv[1]), solid(sys.argv[2])
request = coal.CollisionRequest()
request.enable_contact = True
request.enable_timings = True
if float(sys.argv[4]) > 0:
    request.gjk_tolerance = request.epa_tolerance = float(sys.argv[4])
    request.epa_max_iterations = 1000  # 64 are not enough for the largest solids; room for more costs time itself
collide = coal.ComputeCollision(p, q)
still = numpy.zeros(3)
result = coal.CollisionResult()
queries = []
for line in open(sys.argv[3]):
    numbers = numpy.array(line.split(), dtype=numpy.float64)
    queries.append((coal.Transform3s(numbers[:9].reshape(3, 3), still), coal.Transform3s(numpy.eye(3), numbers[9:])))
least = float("inf")
for _ in range(3):  # its clock is the one on the wall
    microseconds, depths = 0, []
    for p_at, q_at in queries:
        result.clear()
        collide(p_at, q_at, request, result)
        microseconds += result.timings.user
        depths.append(max(0.0, -result.getContact(0).penetration_depth) if result.isCollision() else 0.0)
    least = min(least, microseconds)
print(coal.__version__, least)
for depth in depths:
    print(repr(depth))
