# spf_room(NAME DEPENDS other rooms and libraries...)
# One room of the house = one static library spf_NAME (alias spf::NAME) from the folder's *.cpp, and one
# test program spf_NAME_tests from its *_test.cpp. TEST_DEPENDS are for the tests alone.
# STANDARD is the C++ standard of its sources (default: 17), HEADERS that of its headers where users need less.
# TOGETHER names suites whose tests run in one process, since they share something costly.
# Every test carries the room's name as label, and by the name of its suite two more: `slow` for ...Slow (left out under
# sanitizers) and `threads` for ...Threads (run under the thread sanitizer, built there by target spf_threads_tests).
add_custom_target(spf_threads_tests)

function(spf_room NAME)
  cmake_parse_arguments(ROOM "" "STANDARD;HEADERS" "DEPENDS;TEST_DEPENDS;TOGETHER" ${ARGN})
  if(NOT ROOM_STANDARD)
    set(ROOM_STANDARD 17)
  endif()
  if(NOT ROOM_HEADERS)
    set(ROOM_HEADERS ${ROOM_STANDARD})
  endif()
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  set(tests ${sources})
  list(FILTER sources EXCLUDE REGEX "_test\\.cpp$")
  list(FILTER tests INCLUDE REGEX "_test\\.cpp$")

  # Headers of spf/ are installed as they lie; those of other rooms, with their common names, below spf_rooms/.
  set(below "")
  if(NOT CMAKE_CURRENT_SOURCE_DIR STREQUAL "${PROJECT_SOURCE_DIR}/spf/${NAME}")
    set(below /spf_rooms)
  endif()
  set(target spf_${NAME})
  if(sources)
    add_library(${target} STATIC ${sources})
    set(scope PUBLIC)
    spf_compile_options(${target} ${ROOM_STANDARD})
    spf_precompile(${target} spf_headers_${ROOM_STANDARD})
  else()
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
  endif()
  add_library(spf::${NAME} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${NAME})
  target_compile_features(${target} ${scope} cxx_std_${ROOM_HEADERS})
  target_include_directories(${target} ${scope}
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}${below}>)
  target_link_libraries(${target} ${scope} ${ROOM_DEPENDS})
  if(CMAKE_CURRENT_SOURCE_DIR STREQUAL "${PROJECT_SOURCE_DIR}/spf/${NAME}" AND NOT NAME STREQUAL "testing")
    set_property(GLOBAL APPEND PROPERTY SPF_CORE_TARGETS ${target})
  endif()

  if(SPF_SANITIZE STREQUAL "thread")
    spf_keep_threads(tests)
  endif()
  if(SPF_BUILD_TESTS AND tests)
    add_executable(${target}_tests ${tests})
    spf_compile_options(${target}_tests 20)
    spf_precompile(${target}_tests spf_headers_tests)
    target_compile_features(${target}_tests PRIVATE cxx_std_20)
    target_link_libraries(${target}_tests PRIVATE ${target} ${ROOM_TEST_DEPENDS} GTest::gtest GTest::gmock GTest::gtest_main)
    # Always from batches of sources, which halves what their headers cost.
    set_target_properties(${target}_tests PROPERTIES UNITY_BUILD ON)
    set(together "")
    foreach(suite IN LISTS ROOM_TOGETHER)
      add_test(NAME ${suite} COMMAND ${target}_tests --gtest_filter=${suite}.*)
      set_tests_properties(${suite} PROPERTIES LABELS ${NAME} TIMEOUT 900 COST 100)
      list(APPEND together "${suite}.*")
    endforeach()
    set(one_by_one "*")
    if(SPF_SANITIZE AND NOT SPF_SANITIZE STREQUAL "thread")
      spf_test_in_shards(${NAME} "${together}")
      set(one_by_one "*Slow.*:*Slow/*")
    endif()
    list(JOIN together ":" together)
    gtest_discover_tests(${target}_tests DISCOVERY_TIMEOUT 60 NO_PRETTY_VALUES TEST_FILTER "${one_by_one}-${together}"
      PROPERTIES LABELS ${NAME} TIMEOUT 900)
    spf_label_by_suite(${NAME} ${target}_tests)
    if(SPF_SANITIZE STREQUAL "thread")
      add_dependencies(spf_threads_tests ${target}_tests)
    endif()
  endif()
endfunction()

# A room's tests but ...Slow and EXCEPT, in four processes: under the address sanitizer to start a process costs more than most tests.
function(spf_test_in_shards NAME EXCEPT)
  list(JOIN EXCEPT ":" except)
  foreach(shard RANGE 3)
    add_test(NAME ${NAME}.shard_${shard} COMMAND spf_${NAME}_tests --gtest_brief=1 "--gtest_filter=-*Slow.*:*Slow/*:${except}")
    set_tests_properties(${NAME}.shard_${shard} PROPERTIES LABELS ${NAME} TIMEOUT 1800 COST 50
      ENVIRONMENT "GTEST_TOTAL_SHARDS=4;GTEST_SHARD_INDEX=${shard}")
  endforeach()
endfunction()

# Of these sources, those with suites ...Threads: nothing else is worth the thread sanitizer.
function(spf_keep_threads SOURCES)
  set(kept "")
  foreach(source IN LISTS ${SOURCES})
    file(STRINGS ${source} threads REGEX "^(TYPED_)?TEST(_F|_P)?\\([A-Za-z0-9]*Threads,")
    if(threads)
      list(APPEND kept ${source})
    endif()
  endforeach()
  set(${SOURCES} ${kept} PARENT_SCOPE)
endfunction()

# Suites ...Slow and ...Threads get a second label, when ctest has read the list of the room's tests.
function(spf_label_by_suite NAME TEST_TARGET)
  set(file ${CMAKE_CURRENT_BINARY_DIR}/${TEST_TARGET}_labels.cmake)
  file(CONFIGURE OUTPUT ${file} @ONLY CONTENT [[
foreach(test IN LISTS @TEST_TARGET@_TESTS)
  if(test MATCHES "(Slow|Threads)(/[0-9]+)?\\.")
    string(TOLOWER "${CMAKE_MATCH_1}" label)
    set_tests_properties("${test}" PROPERTIES LABELS "@NAME@;${label}")
    if(label STREQUAL "slow")
      set_tests_properties("${test}" PROPERTIES COST 20)  # what takes long begins early
    endif()
  endif()
endforeach()
]])
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${file})
endfunction()

# Warnings, repeatable floating point (no contraction to FMA), sanitizers. Code is position independent, so that the rooms can
# be linked into a shared library, such as a Python module; no function may be replaced there, so that inlining is as usual.
function(spf_compile_options TARGET STANDARD)
  set_target_properties(${TARGET} PROPERTIES CXX_STANDARD ${STANDARD} CXX_STANDARD_REQUIRED ON CXX_EXTENSIONS OFF)
  target_compile_options(${TARGET} PRIVATE -Wall -Wextra -Wpedantic -Wconversion -Wshadow -ffp-contract=off
    -fPIC -fno-semantic-interposition $<$<BOOL:${SPF_WARNINGS_AS_ERRORS}>:-Werror>)
  if(SPF_SANITIZE)
    # Null and misaligned pointers, half of what the sanitizers cost the compiler, are found without: the address sanitizer stops
    # at the first, nothing here casts pointers to make the second, and Eigen asserts that its own are aligned.
    # What nobody set of a matrix is NaN, so that using it shows (an address sanitizer does not look at that).
    target_compile_options(${TARGET} PRIVATE -fsanitize=${SPF_SANITIZE} -fno-sanitize=null,alignment -fno-omit-frame-pointer
      -fno-sanitize-recover=all -DEIGEN_INITIALIZE_MATRICES_BY_NAN)
    target_link_options(${TARGET} PUBLIC -fsanitize=${SPF_SANITIZE})
  endif()
endfunction()
