# The version and the commit, as one generated source file behind core/base/version.h: a new commit
# compiles that file again and nothing else.

set(TRC_COMMIT "" CACHE STRING "The commit the programs name; empty: asked of git")

function(trc_add_version target)
  set(output "${PROJECT_BINARY_DIR}/generated/core/base/version.cpp")
  add_custom_target(trc_version_source
    COMMAND "${CMAKE_COMMAND}"
      -D "SOURCE_DIR=${PROJECT_SOURCE_DIR}" -D "TRC_VERSION=${PROJECT_VERSION}"
      -D "TRC_COMMIT=${TRC_COMMIT}"
      -D "TEMPLATE=${PROJECT_SOURCE_DIR}/core/base/version.cpp.in" -D "OUTPUT=${output}"
      -P "${PROJECT_SOURCE_DIR}/.cmake/write_version.cmake"
    BYPRODUCTS "${output}"
    COMMENT "Reading the commit" VERBATIM)
  set_source_files_properties("${output}" TARGET_DIRECTORY ${target} PROPERTIES GENERATED ON)
  target_sources(${target} PRIVATE "${output}")
  add_dependencies(${target} trc_version_source)
endfunction()
