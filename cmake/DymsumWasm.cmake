# WebAssembly, by emscripten: flags of everything, and the packages that native builds find installed. docs/guide/web.md.

option(DYMSUM_SIMD "Vector instructions of 128 bits, which an engine may lack" OFF)

# emcc takes -fno-inline-functions along with -Os and -Oz, which leaves calls to operators of vectors and numbers: three
# times as slow, and no smaller.
add_compile_options(-fwasm-exceptions -finline-functions)
add_link_options(-fwasm-exceptions)
if(DYMSUM_SIMD)
  add_compile_options(-msimd128)
endif()

# Read before all others by what has precompiled headers: sorts in little code.
set(DYMSUM_FIRST_HEADER "${PROJECT_SOURCE_DIR}/web/wasm/library/small_sort.h")

# Loops in parallel are left out: their parts follow each other; compressed files, with .3mf, which is one; and databases.
set(DYMSUM_LEFT_OUT base/parallel.cpp io/archive.cpp io/mesh/read_3mf.cpp io/mesh/write_3mf.cpp io/region/database.cpp
  io/region/read_gpkg.cpp io/region/write_gpkg.cpp)

# Packages that are headers alone, by links: the whole of /usr/include would stand before the headers of emscripten's own
# C library.
set(DYMSUM_WASM_HEADERS "${PROJECT_BINARY_DIR}/headers")
file(MAKE_DIRECTORY "${DYMSUM_WASM_HEADERS}")
foreach(package boost nlohmann CLI fast_float fmt)
  find_path(DYMSUM_${package}_AT "${package}" PATHS /usr/include /usr/local/include NO_DEFAULT_PATH NO_CMAKE_FIND_ROOT_PATH REQUIRED)
  file(CREATE_LINK "${DYMSUM_${package}_AT}/${package}" "${DYMSUM_WASM_HEADERS}/${package}" SYMBOLIC)
endforeach()
foreach(target Boost::headers nlohmann_json::nlohmann_json CLI11::CLI11)
  add_library(${target} INTERFACE IMPORTED GLOBAL)
  target_include_directories(${target} SYSTEM INTERFACE "${DYMSUM_WASM_HEADERS}")
endforeach()

# Debian has pugixml compiled for its own machines: here its source is compiled.
set(DYMSUM_PUGIXML_SOURCE "${PROJECT_SOURCE_DIR}/build/pugixml" CACHE PATH "Folder of pugixml's source, with src/pugixml.cpp")
if(NOT EXISTS "${DYMSUM_PUGIXML_SOURCE}/src/pugixml.cpp")
  message(FATAL_ERROR "no source of pugixml in ${DYMSUM_PUGIXML_SOURCE}: ./run web gets it")
endif()
add_library(pugixml STATIC "${DYMSUM_PUGIXML_SOURCE}/src/pugixml.cpp")
add_library(pugixml::pugixml ALIAS pugixml)
target_include_directories(pugixml SYSTEM INTERFACE "${DYMSUM_PUGIXML_SOURCE}/src")
target_compile_definitions(pugixml PRIVATE PUGIXML_NO_XPATH)

# What answers while something is dragged is compiled with -Os, all else with -Oz: a tenth of the size.
set(DYMSUM_QUICK_ROOMS base exact planar/convolution planar/mask planar/arrangement planar/boundary planar/sum planar/position
  planar/result planar/operand planar/motion planar/window planar/frame cspace/events
  cspace/obstacle cspace/boundary cspace/queries spatial/convolution spatial/arrangement spatial/boundary spatial/sum
  spatial/moving spatial/motion spatial/gauss spatial/convex)

# Takes the sources of other rooms out of the library's target into one of objects that are small.
function(dymsum_split target)
  get_target_property(sources ${target} SOURCES)
  set(small ${sources})
  foreach(room IN LISTS DYMSUM_QUICK_ROOMS)
    list(FILTER small EXCLUDE REGEX "/src/${room}/[^/]*$")
  endforeach()
  list(FILTER small INCLUDE REGEX "\\.cpp$")
  dymsum_part(${target} small ${small})
  target_compile_options(${target}_small PRIVATE -Oz)
endfunction()
