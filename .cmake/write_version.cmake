# Run at every build: configure_file leaves an unchanged output alone, so nothing is compiled again.
# Without git, or outside a clone, the commit is unknown; that is no error.

execute_process(
  COMMAND git rev-parse --short=12 HEAD
  WORKING_DIRECTORY "${SOURCE_DIR}"
  OUTPUT_VARIABLE TRC_COMMIT OUTPUT_STRIP_TRAILING_WHITESPACE
  ERROR_QUIET RESULT_VARIABLE failed)
if(failed OR NOT TRC_COMMIT MATCHES "^[0-9a-f]+$")
  set(TRC_COMMIT "unknown")
endif()
configure_file("${TEMPLATE}" "${OUTPUT}" @ONLY)
