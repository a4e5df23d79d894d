# %% [markdown]
# # The no-fit polygons of a nesting instance
# All pairs of its items at 0 and 180 degrees, exactly, on all cores. An instance is a JSON file as nesting programs
# exchange them; without one as argument a small one is written first.

# %%
import sys
import tempfile

import dymsum

# %%
SMALL = """{"name": "small", "items": [
  {"id": 0, "demand": 2, "allowed_orientations": [0, 180], "shape": {"type": "simple_polygon",
    "data": [[0, 0], [3, 0], [3, 1], [1, 1], [1, 3], [0, 3]]}},
  {"id": 1, "demand": 3, "allowed_orientations": [0, 180], "shape": {"type": "simple_polygon",
    "data": [[0, 0], [2, 0], [1, 2]]}}], "strip_height": 10}"""


def small_instance() -> str:
    with tempfile.NamedTemporaryFile("w", suffix=".json", delete=False) as file:
        file.write(SMALL)
    return file.name


# %%
path = sys.argv[1] if len(sys.argv) > 1 and sys.argv[1].endswith(".json") else small_instance()
items = [dymsum.repair(shape.data).region for shape in dymsum.read_shapes(path)]
turned = [part for item in items for part in (item, dymsum.negated(item))]
pairs = [(a, b) for a in turned for b in turned]
table = dymsum.nfp_each(pairs)
tight = sum(len(nfp.tight_segments) + len(nfp.tight_points) for nfp in table)
print(f"{len(items)} items, {len(table)} no-fit polygons of {sum(nfp.vertex_count() for nfp in table)} vertices")
print(f"places of exact fit: {tight}; the largest area is {max(nfp.area() for nfp in table):g}")

# %% [markdown]
# The last one, as the notebook shows it:

# %%
table[-1]
