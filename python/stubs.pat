# What stubs need not tell, or tell otherwise than the module: see nanobind's stubgen.
\.__(reduce|getstate|setstate|hash|copy|deepcopy|repr)__$:

\.__version__$:
    __version__: str

\.__eq__$:
    def __eq__(self, other: object, /) -> bool: ...


# For other packages alone: functions of regions do not take what is rounded.
\.(DiscSet|PlanarSum)\.__geo_interface__$:
