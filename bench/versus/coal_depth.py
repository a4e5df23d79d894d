"""Coal's penetration depths of two convex solids.

coal_depth.py P.off Q.off QUERIES TOLERANCE: a line of QUERIES is P's matrix, row by row, and the translation of Q. Prints
the version, the microseconds of all calls by Coal's own clock, and a depth per query, 0 where they are apart. TOLERANCE
0 leaves Coal's settings as they are."""
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
    request.gjk_max_iterations = request.epa_max_iterations = 10000
collide = coal.ComputeCollision(p, q)
still = numpy.zeros(3)
result = coal.CollisionResult()
microseconds, depths = 0, []
for line in open(sys.argv[3]):
    numbers = numpy.array(line.split(), dtype=numpy.float64)
    p_at = coal.Transform3s(numbers[:9].reshape(3, 3), still)
    q_at = coal.Transform3s(numpy.eye(3), numbers[9:])
    result.clear()
    collide(p_at, q_at, request, result)
    microseconds += result.timings.user
    depths.append(max(0.0, -result.getContact(0).penetration_depth) if result.isCollision() else 0.0)
print(coal.__version__, microseconds)
for depth in depths:
    print(repr(depth))
