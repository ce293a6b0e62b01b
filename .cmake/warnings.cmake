# trc_warnings: what every target of our own code links; generated code does not.

add_library(trc_warnings INTERFACE)
target_compile_options(trc_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow
  $<$<BOOL:${TRC_WERROR}>:-Werror>)
