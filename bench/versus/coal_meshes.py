"""What Coal says of two meshes.

coal_meshes.py P.off Q.off X Y Z: Q is moved by X, Y, Z. Prints the version, its signed distance, how many contacts it
finds, at most 1000, and the largest depth of them."""
import sys

import coal
import numpy


def model(path):
    words = open(path).read().split()[1:]
    vertices, faces = int(words[0]), int(words[1])
    points = numpy.array(words[3:3 + 3 * vertices], dtype=numpy.float64).reshape(-1, 3)
    mesh = coal.BVHModelOBBRSS()
    mesh.beginModel(0, 0)
    at = 3 + 3 * vertices
    triangles = []
    for _ in range(faces):
        corners = [int(word) for word in words[at + 1:at + 1 + int(words[at])]]
        at += 1 + len(corners)
        triangles += [(corners[0], corners[k - 1], corners[k]) for k in range(2, len(corners))]
    for a, b, c in triangles:
        mesh.addTriangle(points[a], points[b], points[c])
    mesh.endModel()
    return mesh


p, q = model(sys.argv[1]), model(sys.argv[2])
move = numpy.array(sys.argv[3].split(), dtype=numpy.float64)
still, moved = coal.Transform3s.Identity(), coal.Transform3s(numpy.eye(3), move)
nearest = coal.DistanceResult()
distance_request = coal.DistanceRequest()
distance_request.enable_signed_distance = True
distance = coal.distance(p, still, q, moved, distance_request, nearest)
request = coal.CollisionRequest(coal.CollisionRequestFlag.CONTACT, 1000)
result = coal.CollisionResult()
coal.collide(p, still, q, moved, request, result)
depths = [-result.getContact(k).penetration_depth for k in range(result.numContacts())]
print(coal.__version__, float(distance), len(depths), max(depths, default=0.0))
