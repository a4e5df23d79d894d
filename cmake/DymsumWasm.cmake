# WebAssembly, by emscripten: flags of everything, and the packages that native builds find installed. docs/guide/web.md.

option(DYMSUM_SIMD "Vector instructions of 128 bits, which an engine may lack" OFF)

add_compile_options(-fwasm-exceptions)
add_link_options(-fwasm-exceptions)
if(DYMSUM_SIMD)
  add_compile_options(-msimd128)
endif()

# Loops in parallel are left out: their parts follow each other.
set(DYMSUM_LEFT_OUT parallel.cpp)

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
