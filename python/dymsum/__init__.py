"""Exact Minkowski sums of polygons and of solids, kept exact while shapes move; and what people build from them.

Names are those of the C++ library: classes in CamelCase, functions and fields in snake_case; `from`, `in` and other
keywords of Python end in an underscore. Exact numbers are `fractions.Fraction`; errors are `dymsum.Error`.
Coordinates have the unit that they are given in; angles are in radians. See docs/guide/python.md.
"""

import copyreg
from fractions import Fraction as Fraction

from . import _core
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

#: The library's exact numbers are Python's.
Rational = Fraction

__version__ = _core.__version__

# Functions of the compiled part are pickled by their names, as others are.
copyreg.pickle(type(_core.nfp), lambda function: str(function.__qualname__))
