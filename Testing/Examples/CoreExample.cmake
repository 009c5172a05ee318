# The example of Core/ with the core of this tree and, where the core is built alone, against its installation, as a user would.
set(core_example "${CMAKE_CURRENT_LIST_DIR}/Core")
set(problem "${CMAKE_CURRENT_LIST_DIR}/FourWays/double_torus.ply")
set(answers "${PROJECT_BINARY_DIR}/Testing/Examples/FourWays") # see CMakeLists.txt
file(MAKE_DIRECTORY "${answers}")

add_executable(SmoothField "${core_example}/SmoothField.cxx")
target_link_libraries(SmoothField PRIVATE DirectionalMultigrid::Core)
add_test(NAME Examples.Core COMMAND SmoothField "${problem}" "${answers}/core.txt")
add_executable(Flow "${core_example}/Flow.cxx")
target_link_libraries(Flow PRIVATE DirectionalMultigrid::Core)
add_test(NAME Examples.Core.Flow COMMAND Flow "${problem}" "${answers}/core-flow.txt")
set_tests_properties(Examples.Core Examples.Core.Flow PROPERTIES LABELS core FIXTURES_SETUP answers)

if (DMG_HOST STREQUAL "None")
  set(stage "${PROJECT_BINARY_DIR}/Stage")
  set(build "${PROJECT_BINARY_DIR}/Testing/Examples/Core")
  set(flags "")
  if (DMG_SANITIZER)
    set(flags "-fsanitize=${DMG_SANITIZER}") # as the archive needs it
  endif ()
  string(REPLACE ";" "$<SEMICOLON>" paths "${stage};${CMAKE_PREFIX_PATH}")
  add_test(NAME Examples.Core.Install
    COMMAND "${CMAKE_COMMAND}" --install "${PROJECT_BINARY_DIR}" --prefix "${stage}")
  add_test(NAME Examples.Core.Installed
    COMMAND "${CMAKE_CTEST_COMMAND}"
      --build-and-test "${core_example}" "${build}"
      --build-generator "${CMAKE_GENERATOR}"
      --build-options "-DCMAKE_BUILD_TYPE=${CMAKE_BUILD_TYPE}" "-DCMAKE_PREFIX_PATH=${paths}" "-DCMAKE_CXX_FLAGS=${flags}"
      --test-command "${build}/SmoothField" "${problem}" "${answers}/installed.txt")
  add_test(NAME Examples.Core.SameAnswers
    COMMAND "${CMAKE_COMMAND}" -E compare_files "${answers}/core.txt" "${answers}/installed.txt")
  set_tests_properties(Examples.Core.Install PROPERTIES LABELS core FIXTURES_SETUP stage)
  set_tests_properties(Examples.Core.Installed PROPERTIES
    LABELS core TIMEOUT 300 FIXTURES_REQUIRED stage FIXTURES_SETUP answers)
  set_tests_properties(Examples.Core.SameAnswers PROPERTIES LABELS core FIXTURES_REQUIRED answers)
endif ()
