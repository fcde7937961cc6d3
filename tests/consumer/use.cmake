# Configures, builds and runs tests/consumer/project. WAY: subdirectory, or package (installed first).
file(REMOVE_RECURSE ${WORK_DIR})
set(arguments -DCONSUME=${WAY} -DMANYLIGHTS_SOURCE=${SOURCE_DIR})
if(WAY STREQUAL "package")
  execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${WORK_DIR}/installed
                  COMMAND_ERROR_IS_FATAL ANY OUTPUT_QUIET)
  set(arguments -DCONSUME=${WAY} -DCMAKE_PREFIX_PATH=${WORK_DIR}/installed)
endif()
execute_process(
  COMMAND ${CMAKE_COMMAND} -S ${SOURCE_DIR}/tests/consumer/project -B ${WORK_DIR}/build -G ${GENERATOR} ${arguments}
          -DCMAKE_CXX_COMPILER=${CXX_COMPILER} "-DCMAKE_CXX_FLAGS=${CXX_FLAGS}" "-DCMAKE_C_FLAGS=${CXX_FLAGS}"
          -DCMAKE_BUILD_TYPE=${BUILD_TYPE} -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}
  COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --build ${WORK_DIR}/build COMMAND_ERROR_IS_FATAL ANY)
foreach(program consumer_c consumer_cpp)
  execute_process(COMMAND ${WORK_DIR}/build/${program} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
