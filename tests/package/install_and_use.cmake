# Installs the build in BUILD_DIR below WORK_DIR, then configures, builds and runs the foreign project in SOURCE_DIR
# against nothing but that installation.
function(step)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE code OUTPUT_VARIABLE text ERROR_VARIABLE text)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${ARGV}\nended with ${code}:\n${text}")
  endif()
  set(output "${text}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE "${WORK_DIR}")
step("${CMAKE_COMMAND}" --install "${BUILD_DIR}" --prefix "${WORK_DIR}/prefix")
step("${CMAKE_COMMAND}" -S "${SOURCE_DIR}" -B "${WORK_DIR}/build" -G "${GENERATOR}"
  "-DCMAKE_CXX_COMPILER=${CXX}" "-DCMAKE_PREFIX_PATH=${WORK_DIR}/prefix" -DCMAKE_BUILD_TYPE=Release)
step("${CMAKE_COMMAND}" --build "${WORK_DIR}/build")
step("${WORK_DIR}/build/foreign")
if(NOT output STREQUAL "16\n")
  message(FATAL_ERROR "the foreign program printed '${output}' instead of 16")
endif()

file(GLOB config "${WORK_DIR}/prefix/lib*/cmake/dymsum/*.cmake" "${WORK_DIR}/prefix/lib*/*/cmake/dymsum/*.cmake")
foreach(file IN LISTS config)
  file(READ "${file}" text)
  if(text MATCHES "gmp|CGAL|Boost|nlohmann")
    message(FATAL_ERROR "${file} asks users for ${CMAKE_MATCH_0}")
  endif()
endforeach()
