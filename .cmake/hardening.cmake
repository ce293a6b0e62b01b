# trc_hardening: run time defences of the shipped programs.

add_library(trc_hardening INTERFACE)
target_compile_options(trc_hardening INTERFACE -fstack-protector-strong)
target_link_options(trc_hardening INTERFACE
  -Wl,-z,relro -Wl,-z,now -Wl,-z,noexecstack -Wl,--as-needed)

if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64|i[3-6]86")
  target_compile_options(trc_hardening INTERFACE -fcf-protection)
endif()

# The checked string functions need optimisation, and hide errors from the sanitizers.
if(NOT TRC_SANITIZE AND NOT TRC_FUZZ)
  target_compile_options(trc_hardening INTERFACE
    $<$<NOT:$<CONFIG:Debug>>:-U_FORTIFY_SOURCE>
    $<$<NOT:$<CONFIG:Debug>>:-D_FORTIFY_SOURCE=2>)
endif()
