# Language, output folders and code generation that hold for every target.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/bin")

# The programs listen on a port: position independent for address space layout randomisation.
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
include(CheckPIESupported)
check_pie_supported(LANGUAGES CXX)

set(CMAKE_CXX_FLAGS_DEV "${CMAKE_CXX_FLAGS_DEV_INIT}" CACHE STRING "Flags of the Dev build type")
set(CMAKE_EXE_LINKER_FLAGS_DEV "" CACHE STRING "Linker flags of the Dev build type")
mark_as_advanced(CMAKE_CXX_FLAGS_DEV CMAKE_EXE_LINKER_FLAGS_DEV)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Dev CACHE STRING "Dev, Debug, Release or RelWithDebInfo" FORCE)
endif()

# The same answer on every machine: no fused multiply-add behind our back.
add_compile_options(-ffp-contract=off)

# Nobody replaces a function of ours at load time: what one file has may be inlined within it,
# position independent or not.
add_compile_options(-fno-semantic-interposition)

if(TRC_SANITIZE)
  add_compile_options(-fsanitize=${TRC_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${TRC_SANITIZE})
endif()

if(TRC_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    message(FATAL_ERROR "TRC_FUZZ needs clang, the compiler is ${CMAKE_CXX_COMPILER_ID}")
  endif()
  add_compile_options(-fsanitize=fuzzer-no-link)
endif()

# Precompiled headers need the named leniency, or ccache would never find an answer.
find_program(TRC_CCACHE ccache)
mark_as_advanced(TRC_CCACHE)
if(TRC_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${CMAKE_COMMAND}" -E env
      CCACHE_SLOPPINESS=pch_defines,time_macros "${TRC_CCACHE}")
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND NOT CMAKE_DISABLE_PRECOMPILE_HEADERS)
    add_compile_options(-fpch-preprocess)
  endif()
endif()

# GCC sets structs of some hundred bytes to zero with `rep stos`, which takes longer to begin than
# plain stores take to end: a tenth of the time of a block. Other compilers do without.
include(CheckCXXCompilerFlag)
set(zero_by_stores -mmemset-strategy=vector_loop:512:noalign,libcall:-1:noalign)
check_cxx_compiler_flag(${zero_by_stores} TRC_ZERO_BY_STORES)
if(TRC_ZERO_BY_STORES)
  add_compile_options("$<$<CONFIG:Release>:${zero_by_stores}>")
endif()
