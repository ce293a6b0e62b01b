# Fails when a folder includes what it must not know. Run: cmake -D ROOT=<source tree> -P layers.cmake
#
#   base <- messages <- geometry <- nc/text <- nc/state <- nc/dialect <- nc/program <- trc <- nc/writer
#   nc/writer <- nc/convert <- verify <- session <- survey <- wire <- server, client
#
# Quoted includes name a file from the top of the source tree. What a folder may include is one
# regular expression for these and one for the headers in angle brackets, the standard library's
# always allowed.

set(standard "[a-z_]+")
set(generated "trc/v1/.*|google/rpc/.*|grpc/.*")

# `folder` may also be how the names of some files begin.
function(layer folder quoted angled)
  if(IS_DIRECTORY "${ROOT}/${folder}")
    file(GLOB_RECURSE files RELATIVE "${ROOT}" "${ROOT}/${folder}/*.h" "${ROOT}/${folder}/*.cpp"
         "${ROOT}/${folder}/*.h.in" "${ROOT}/${folder}/*.cpp.in")
  else()
    file(GLOB files RELATIVE "${ROOT}" "${ROOT}/${folder}*")
  endif()
  foreach(file IN LISTS files)
    file(STRINGS "${ROOT}/${file}" includes REGEX "^[ \t]*#[ \t]*include")
    foreach(include IN LISTS includes)
      if(include MATCHES "include[ \t]*\"([^\"]*)\"" AND NOT CMAKE_MATCH_1 MATCHES "^(${quoted})$")
        message(SEND_ERROR "${file} must not have ${include}")
      elseif(include MATCHES "include[ \t]*<([^>]*)>"
             AND NOT CMAKE_MATCH_1 MATCHES "^(${standard}|${angled})$")
        message(SEND_ERROR "${file} must not have ${include}")
      endif()
    endforeach()
  endforeach()
endfunction()

set(known "core/base/.*")
# Memory goes back to the system by its pages.
layer(core/base "${known}" "cereal/.*|sys/mman\\.h|unistd\\.h")
string(APPEND known "|core/messages/.*")
layer(core/messages "${known}" "")
foreach(folder geometry nc/text nc/state nc/dialect nc/program)
  string(APPEND known "|core/${folder}/.*")
  layer(core/${folder} "${known}" "Eigen/.*")
endforeach()
# The verification takes of trc what follows from the program alone, and the path that came out.
set(of_trc "core/trc/((result|walls)/.*|(lead_settings|state_archive)\\.h)")
layer(core/verify "${known}|core/verify/.*|${of_trc}" "Eigen/.*")
foreach(folder trc nc/writer nc/convert verify session survey)
  string(APPEND known "|core/${folder}/.*")
  layer(core/${folder} "${known}" "Eigen/.*")
endforeach()

# The rooms of core/trc and the files beside them, each above those before it.
string(REPLACE "|core/trc/.*" "" in_trc "${known}")
foreach(place lead_settings.h setup.h pass.h result path_block.h state_archive.h corner selection
        joints walls loops passes short_way compensator.h entry_trial entry_help compensator)
  if(IS_DIRECTORY "${ROOT}/core/trc/${place}")
    string(APPEND in_trc "|core/trc/${place}/.*")
  else()
    string(APPEND in_trc "|core/trc/${place}.*")
  endif()
  layer(core/trc/${place} "${in_trc}" "Eigen/.*")
endforeach()

string(APPEND known "|proto/wire/.*|(proto/)?(${generated})")
layer(proto/wire "${known}" "Eigen/.*|google/protobuf/.*")
layer(server "${known}|server/.*" ".*")

# The client library is for other people's programs; only the command line runs a server of its own.
layer(client/trc "${known}|client/trc/.*" ".*")
# What is linked without gRPC.
layer(client/c "${known}|client/c/.*" "stddef\\.h|stdint\\.h")
layer(client/plot "${known}|client/(trc|plot)/.*" ".*")
layer(client/load "${known}|client/(trc|load)/.*" ".*")
layer(client/cli "${known}|client/.*|server/.*" ".*")
