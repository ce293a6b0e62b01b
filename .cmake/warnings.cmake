# trc_warnings: what every target of our own code links; generated code does not.

add_library(trc_warnings INTERFACE)
target_compile_options(trc_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow
  $<$<BOOL:${TRC_WERROR}>:-Werror>)

# Once it inlines, g++ 12 finds overflows inside std::string that are not there. clang and
# AddressSanitizer watch over the real ones.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(trc_warnings INTERFACE
    -Wno-array-bounds -Wno-restrict -Wno-stringop-overflow -Wno-stringop-overread)
endif()
