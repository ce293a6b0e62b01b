# Run at every build: configure_file leaves an unchanged output alone, so nothing is compiled again.
# Without git, or outside a clone, the commit is unknown; that is no error.

if(NOT TRC_COMMIT)
  execute_process(
    COMMAND git rev-parse --short=12 HEAD
    WORKING_DIRECTORY "${SOURCE_DIR}"
    OUTPUT_VARIABLE TRC_COMMIT OUTPUT_STRIP_TRAILING_WHITESPACE
    ERROR_QUIET)
endif()
if(NOT TRC_COMMIT MATCHES "^[0-9a-f]+$")
  set(TRC_COMMIT "unknown")
endif()
configure_file("${TEMPLATE}" "${OUTPUT}" @ONLY)
