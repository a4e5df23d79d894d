# %% [markdown]
# # Nesting with exact positions, and a proof
# Parts are placed in a strip, largest first, each as far to the left as it fits beside those that are placed. Positions
# are vertices of the exact feasible set, so exact fits are found, and the layout is proved in the end.

# %%
import math
import sys

import dymsum

# %%
SMALL = """{"strip_height": 6, "items": [
  {"id": "ell", "demand": 4, "allowed_orientations": [0, 90, 180, 270], "shape": {"type": "simple_polygon",
    "data": [[0, 0], [4, 0], [4, 2], [2, 2], [2, 4], [0, 4]]}},
  {"id": "square", "demand": 5, "allowed_orientations": [0], "shape": {"type": "simple_polygon",
    "data": [[0, 0], [2, 0], [2, 2], [0, 2]]}}]}"""
given = sys.argv[1] if len(sys.argv) > 1 and sys.argv[1].endswith(".json") else None
instance = dymsum.read_nesting_instance(given) if given else dymsum.parse_nesting_instance(SMALL)
items = [dymsum.repair(item.shape).region for item in instance.items]

# %%
boxes = [dymsum.bounds(item) for item in items]
length = sum(
    kind.demand * math.hypot(box[2] - box[0], box[3] - box[1]) for kind, box in zip(instance.items, boxes)
)
placement = dymsum.Placement(dymsum.shapes.rectangle(0, 0, length, instance.strip_height))
origin = dymsum.Region.create(dymsum.RegionData(points=[(0, 0)]))
kinds = []  # of each item the indices of its turned shapes, and how far these reach to the right
for index, (kind, item) in enumerate(zip(instance.items, items)):
    turned = []
    for degrees in kind.degrees:
        theta = dymsum.Orientation.nearest(math.radians(degrees))
        parts = dymsum.rotated_sum(item, origin, theta).parts
        reach = max(vertex.at.x for part in parts for vertex in part.outer.vertices)
        turned.append((placement.add_shape(item, theta), theta, reach))
    kinds.append((dymsum.area(item), index, kind.demand, turned))

# %%
layout, used = [], 0.0
for _, index, demand, turned in sorted(kinds, key=lambda kind: -kind[0]):
    for _ in range(demand):
        choices = []
        for shape, theta, reach in turned:
            feasible = placement.feasible(shape)
            if feasible.candidates:  # by x, then y
                vertex = feasible.candidates[0].vertex
                choices.append((vertex.at.x + reach, shape, theta, feasible.set.exact(vertex)))
        end, shape, theta, at = min(choices, key=lambda choice: choice[:2])
        placement.add_part(shape, at)
        layout.append(dymsum.LayoutPart(index, at, theta))
        used = max(used, end * (1 + 1e-12))

# %%
strip = dymsum.shapes.rectangle(0, 0, used, instance.strip_height)
check = dymsum.check_layout(dymsum.Layout(items, layout, strip))
print(f"{len(layout)} parts, length {used:.5g}, density {check.density:.4f}: {'proved' if check.valid() else 'wrong'}")

# %% [markdown]
# What is left for another square:

# %%
placement.feasible(kinds[-1][3][0][0]).set
