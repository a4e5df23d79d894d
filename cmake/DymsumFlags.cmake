# The compiler flags of everything in this project. Contraction is off and fast-math is never on: the floating-point
# filters are proved for plain IEEE double operations in the written order.

set(DYMSUM_SANITIZE_FLAGS -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
# Checks at every access to a member, and of every sum of a pointer and an index, are a third of the time to build. The
# address sanitizer finds null, short objects and what is outside its array too.
option(DYMSUM_SANITIZE_MEMBERS "With DYMSUM_SANITIZE: also check alignment and dynamic type at every access to a member" OFF)
if(NOT DYMSUM_SANITIZE_MEMBERS)
  list(APPEND DYMSUM_SANITIZE_FLAGS -fno-sanitize=null,object-size,alignment,vptr,pointer-overflow)
endif()

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES AND PROJECT_IS_TOP_LEVEL)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()

function(dymsum_set_flags target)
  set_target_properties(${target} PROPERTIES CXX_STANDARD_REQUIRED ON CXX_EXTENSIONS OFF)
  target_compile_features(${target} PRIVATE cxx_std_20)
  target_compile_options(${target} PRIVATE -ffp-contract=off -Wall -Wextra -Wpedantic)
  # Two warnings of GCC's optimiser are wrong about correct code: -Wrestrict about `"x" + std::string` (GCC bug 105651),
  # and -Wmaybe-uninitialized about the union inside Boost's cpp_int.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE -Wno-restrict -Wno-maybe-uninitialized)
  else()
    # & of comparisons is meant where nothing may branch.
    target_compile_options(${target} PRIVATE -Wno-bitwise-instead-of-logical)
  endif()
  if(DYMSUM_WARNINGS_AS_ERRORS)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  if(DYMSUM_SANITIZE)
    target_compile_options(${target} PRIVATE ${DYMSUM_SANITIZE_FLAGS})
    target_link_options(${target} PUBLIC ${DYMSUM_SANITIZE_FLAGS})
  endif()
endfunction()

# A target of any build under sanitizers: with what the preset debug has, its checks of contracts (assert) as well.
function(dymsum_sanitize target)
  target_compile_options(${target} PRIVATE -O1 -g1 -UNDEBUG ${DYMSUM_SANITIZE_FLAGS})
  target_link_options(${target} PUBLIC ${DYMSUM_SANITIZE_FLAGS})
endfunction()

# Reads HEADERs once for all files of a target. GCC 12's optimiser then warns of overflows that cannot happen, in strings and
# vectors of the standard library: that their headers are the system's is forgotten in a precompiled header.
function(dymsum_precompile target)
  target_precompile_headers(${target} PRIVATE ${ARGN})
  dymsum_trust_precompiled(${target})
endfunction()

# The same with the precompiled header of another target, which has the same flags.
function(dymsum_reuse_precompiled target other)
  target_precompile_headers(${target} REUSE_FROM ${other})
  dymsum_trust_precompiled(${target})
endfunction()

function(dymsum_trust_precompiled target)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread)
  endif()
endfunction()

# All files of a folder in one translation unit: their headers are read, and their templates instantiated, once. For builds
# from nothing; where files change, single ones are faster. Files of a folder may not use a name for two things.
option(DYMSUM_UNITY "Compile the files of a folder together" OFF)
function(dymsum_unite target)
  if(NOT DYMSUM_UNITY)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  # Classes of one source file may have members of its anonymous namespace.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE -Wno-subobject-linkage)
  endif()
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources EXCLUDE REGEX "^\\$<")  # objects of a part
  foreach(source IN LISTS sources)
    cmake_path(RELATIVE_PATH source BASE_DIRECTORY "${PROJECT_SOURCE_DIR}" OUTPUT_VARIABLE group)
    cmake_path(GET group PARENT_PATH group)
    string(REPLACE "/" "_" group "${group}")
    set_source_files_properties("${source}" PROPERTIES UNITY_GROUP "${group}")
  endforeach()
endfunction()

# Takes SOURCES out of a library's target into objects of their own, target_PART, which the library still holds.
function(dymsum_part target part)
  get_target_property(sources ${target} SOURCES)
  list(REMOVE_ITEM sources ${ARGN})
  set_target_properties(${target} PROPERTIES SOURCES "${sources}")
  add_library(${target}_${part} OBJECT ${ARGN})
  dymsum_set_library(${target}_${part})
  target_sources(${target} PRIVATE $<TARGET_OBJECTS:${target}_${part}>)
endfunction()
