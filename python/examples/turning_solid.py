# %% [markdown]
# # A rod turns beside a box: how deep do they overlap?
# The sum of the rod and the reflected box holds the translations at which they overlap. It follows the turn exactly,
# and the depth is a global minimum.

# %%
import numpy

import dymsum
from dymsum import ConvexSum, Rotation, solids

# %%
rod, box = solids.rod(18, 9, 0.5, 3), solids.box(-1, -1, -1, 1, 1, 1)
overlaps = ConvexSum(rod, dymsum.negated(box))
step = Rotation.about((1, 2, 3), 0.05)
for frame in range(4):
    work = overlaps.set(step * overlaps.p_pose().rotation)
    depth = overlaps.depth((0.75, 0, 0))
    print(f"{overlaps.facet_count().all} facets, {work.facets_added} new; depth {depth.depth:.6f}")

# %% [markdown]
# Many turns at once, on all cores:

# %%
quaternions = numpy.random.default_rng(1).normal(size=(200, 4))
reports = dymsum.pose_batch_arrays(rod, dymsum.negated(box), quaternions, dymsum.BatchOptions(depth_point=(0.75, 0, 0)))
print(f"depths from {reports.depth.min():.3f} to {reports.depth.max():.3f}")

# %% [markdown]
# The sum at the last turn:

# %%
overlaps.sum()
