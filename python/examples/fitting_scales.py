# %% [markdown]
# # At which scales does a part fit?
# Exactly, and the answer is a set of scales: a larger part may fit where a smaller one is blocked.

# %%
import dymsum
from dymsum import shapes

# %%
part, cavity = shapes.letter_l(3, 2, 1), shapes.rectangle(0, 0, 7, 5)
fit = dymsum.fit_range(part, cavity)
for interval in fit.free:
    print("it fits inside from scale", interval.low or 0, "to", interval.high)
print("contacts at the largest:", sorted(contact.kind.name for contact in fit.free[-1].at_high))

# %% [markdown]
# Moved along a path between two posts:

# %%
posts = dymsum.Region("MULTIPOLYGON(((0 1.5, 1 1.5, 1 4, 0 4, 0 1.5)), ((0 -4, 1 -4, 1 -1.25, 0 -1.25, 0 -4)))")
way = dymsum.scale_range(shapes.star(5, 0.5, 1), [(-4, 0), (4, 0)], posts)
print("blocked just above scale", way.trap(), "=", float(way.trap() or 0))

# %% [markdown]
# The sum as the star grows, and the scales at which its shape changes:

# %%
growing = dymsum.ScalingSum(shapes.star(5, 0.5, 1), posts)
events = [event for event in growing.events(1, 3) if event.topology]
print(len(events), "changes of topology between scales 1 and 3:", [f"{event.approx:.4f}" for event in events])
growing.set(events[0].s if events else 2)
growing.sum()
