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

# Configured as a folder of another project, whose choices stay; it would compile the core once more.
add_test(NAME Examples.Core.Subproject
  COMMAND "${CMAKE_COMMAND}" -S "${CMAKE_CURRENT_LIST_DIR}/Subproject" -B "${PROJECT_BINARY_DIR}/Testing/Examples/Subproject"
    -G "${CMAKE_GENERATOR}" "-DSOURCES=${PROJECT_SOURCE_DIR}")
set_tests_properties(Examples.Core.Subproject PROPERTIES LABELS core)

# The same crosses on two ranks.
set(pieces_example "${CMAKE_CURRENT_LIST_DIR}/Pieces")
find_program(MPIEXEC_OF_TESTS mpiexec)
set(two_ranks "${MPIEXEC_OF_TESTS}" --oversubscribe -n 2)
set(environment_of_ranks OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
  OMPI_MCA_mpi_yield_when_idle=1)
if (DMG_PETSC AND MPIEXEC_OF_TESTS AND NOT DMG_SANITIZER)
  add_executable(SmoothFieldInPieces "${pieces_example}/SmoothFieldInPieces.cxx")
  target_link_libraries(SmoothFieldInPieces PRIVATE DirectionalMultigrid::Pieces)
  add_test(NAME Examples.Pieces
    COMMAND ${two_ranks} "$<TARGET_FILE:SmoothFieldInPieces>" "${problem}" "${answers}/pieces.txt")
  set_tests_properties(Examples.Pieces PROPERTIES LABELS core TIMEOUT 120 FIXTURES_SETUP answers
    ENVIRONMENT "${environment_of_ranks}")
  if (NOT DMG_HOST STREQUAL "None") # their Python has numpy
    find_package(Python3 REQUIRED COMPONENTS Interpreter)
    add_test(NAME Examples.Pieces.SameAnswers
      COMMAND Python3::Interpreter "${CMAKE_CURRENT_LIST_DIR}/FourWays/TestSameAnswers.py"
        "${problem}" "${answers}/core.txt" "${answers}/pieces.txt")
    set_tests_properties(Examples.Pieces.SameAnswers PROPERTIES LABELS core FIXTURES_REQUIRED answers)
  endif ()
endif ()

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

  set(build "${PROJECT_BINARY_DIR}/Testing/Examples/Pieces")
  if (TARGET SmoothFieldInPieces)
    add_test(NAME Examples.Pieces.Installed
      COMMAND "${CMAKE_CTEST_COMMAND}"
        --build-and-test "${pieces_example}" "${build}"
        --build-generator "${CMAKE_GENERATOR}"
        --build-options "-DCMAKE_BUILD_TYPE=${CMAKE_BUILD_TYPE}" "-DCMAKE_PREFIX_PATH=${paths}"
        --test-command ${two_ranks} "${build}/SmoothFieldInPieces" "${problem}" "${answers}/installed-pieces.txt")
    add_test(NAME Examples.Pieces.SameAnswersInstalled
      COMMAND "${CMAKE_COMMAND}" -E compare_files "${answers}/pieces.txt" "${answers}/installed-pieces.txt")
    set_tests_properties(Examples.Pieces.Installed PROPERTIES
      LABELS core TIMEOUT 300 FIXTURES_REQUIRED stage FIXTURES_SETUP answers ENVIRONMENT "${environment_of_ranks}")
    set_tests_properties(Examples.Pieces.SameAnswersInstalled PROPERTIES LABELS core FIXTURES_REQUIRED answers)
  elseif (NOT DMG_PETSC)
    add_test(NAME Examples.Pieces.Refused
      COMMAND "${CMAKE_COMMAND}" -S "${pieces_example}" -B "${build}" "-DCMAKE_PREFIX_PATH=${paths}")
    set_tests_properties(Examples.Pieces.Refused PROPERTIES
      LABELS core FIXTURES_REQUIRED stage PASS_REGULAR_EXPRESSION "The component Pieces is missing")
  endif ()
endif ()
