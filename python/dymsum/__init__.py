"""Exact Minkowski sums of polygons and of solids, kept exact while shapes move; and what people build from them.

Names are those of the C++ library: classes in CamelCase, functions and fields in snake_case; `from`, `in` and other
keywords of Python end in an underscore. Exact numbers are `fractions.Fraction`; errors are `dymsum.Error`.
Coordinates have the unit that they are given in; angles are in radians. See docs/guide/python.md.

All names are here, and by subject in the modules regions, sums, motions, robots, meshes, solid_sums, depths, fits,
nesting, discs, features, uncertainty and errors; generators of shapes are in shapes and solids.
"""

import copyreg as _copyreg
from fractions import Fraction as Fraction

from . import _interpreters as _interpreters  # before the compiled part
from . import _core
from . import _reprs as _reprs
from ._convert import MeshLike as MeshLike
from ._convert import RegionLike as RegionLike
from ._convert import to_shapely as to_shapely
from ._convert import to_trimesh as to_trimesh
from ._core import *
from . import shapes as shapes
from . import solids as solids
from ._errors import Error as Error
from ._errors import Evidence as Evidence
from ._values import Clearances as Clearances
from ._values import Configuration as Configuration
from ._values import DepthRows as DepthRows
from ._values import Point as Point
from ._values import Point3 as Point3
from ._values import PoseReports as PoseReports
from ._values import RationalPoint as RationalPoint
from ._values import RationalPoint3 as RationalPoint3
from . import depths as depths
from . import discs as discs
from . import errors as errors
from . import features as features
from . import fits as fits
from . import meshes as meshes
from . import motions as motions
from . import nesting as nesting
from . import regions as regions
from . import robots as robots
from . import solid_sums as solid_sums
from . import sums as sums
from . import uncertainty as uncertainty

#: The library's exact numbers are Python's.
Rational = Fraction

__version__ = _core.__version__

__all__ = ["MeshLike", "Rational", "RegionLike", "shapes", "solids", "to_shapely", "to_trimesh", "version"]
__all__ += ["depths", "discs", "errors", "features", "fits", "meshes", "motions", "nesting", "regions", "robots"]
__all__ += ["solid_sums", "sums", "uncertainty"]
__all__ += depths.__all__
__all__ += discs.__all__
__all__ += errors.__all__
__all__ += features.__all__
__all__ += fits.__all__
__all__ += meshes.__all__
__all__ += motions.__all__
__all__ += nesting.__all__
__all__ += regions.__all__
__all__ += robots.__all__
__all__ += solid_sums.__all__
__all__ += sums.__all__
__all__ += uncertainty.__all__
__all__ = sorted(set(__all__))

# Functions of the compiled part are pickled by their names, as others are.
_copyreg.pickle(type(_core.nfp), lambda function: str(function.__qualname__))
