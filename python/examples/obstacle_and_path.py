# %% [markdown]
# # A rod finds its way out of a room
# The obstacle holds all positions and angles at which the rod hits the walls; the plan is a proof, every piece of it is
# free in every point, and so would be the answer "there is none".

# %%
import math

import dymsum

# %%
rod = dymsum.Region([(-1.1, -0.1), (1.1, -0.1), (1.1, 0.1), (-1.1, 0.1)])
room = dymsum.Region("""POLYGON((0 0, 8 0, 8 5, 4.7 5, 4.7 4.8, 7.8 4.8, 7.8 0.2, 0.2 0.2, 0.2 4.8, 4.3 4.8, 4.3 5,
                                  0 5, 0 0))""")  # fmt: skip
obstacle = dymsum.CspaceObstacle(rod, room)
plan = dymsum.plan(obstacle, start=(2, 1, 0), goal=(4, 8, 0))
assert plan.found()
print(f"{len(obstacle.patches())} patches; a path of {len(plan.path)} waypoints")

# %% [markdown]
# How much room is there on the way, and is every piece free?

# %%
clear = dymsum.ObstacleQueries(obstacle).clearance_each(plan.configurations)
print(f"closest at a waypoint: {clear.distance.min():.3f}")
print("the path is", dymsum.check_path(rod, room, plan.path).outcome.name)


# %% [markdown]
# A picture of the rod on its way, without any plotting package:


# %%
class Picture:
    """SVG text that a notebook shows."""

    def __init__(self) -> None:
        self.shapes: list[str] = []

    def add(self, points: list[tuple[float, float]], fill: str) -> None:
        text = " ".join(f"{40 * x:.1f},{-40 * y:.1f}" for x, y in points)
        self.shapes.append(f'<polygon points="{text}" fill="{fill}" stroke="#333" stroke-width="0.5"/>')

    def _repr_svg_(self) -> str:
        head = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="-20 -400 360 420" width="360">'
        return head + "".join(self.shapes) + "</svg>"


picture = Picture()
picture.add(room.parts[0].outer.tolist(), "#bbb")
for x, y, theta in plan.configurations:
    c, s = math.cos(theta), math.sin(theta)
    picture.add([(x + c * u - s * v, y + s * u + c * v) for u, v in rod.parts[0].outer], "rgba(30,120,220,0.4)")
picture
