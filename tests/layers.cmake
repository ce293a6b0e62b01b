# Fails when a folder includes what it must not know. Run: cmake -D ROOT=<source tree> -P layers.cmake
#
#   base <- geometry <- nc/text <- nc/state <- nc/dialect <- nc/program <- trc <- nc/writer <- nc/convert
#   nc/convert <- verify <- session <- survey <- wire <- server, client
#
# Quoted includes name a file from the top of the source tree. What a folder may include is one
# regular expression for these and one for the headers in angle brackets, the standard library's
# always allowed.

set(standard "[a-z_]+")
set(generated "trc/v1/.*|google/rpc/.*|grpc/.*")

function(layer folder quoted angled)
  file(GLOB_RECURSE files RELATIVE "${ROOT}" "${ROOT}/${folder}/*.h" "${ROOT}/${folder}/*.cpp"
       "${ROOT}/${folder}/*.h.in" "${ROOT}/${folder}/*.cpp.in")
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
foreach(folder geometry nc/text nc/state nc/dialect nc/program)
  string(APPEND known "|core/${folder}/.*")
  layer(core/${folder} "${known}" "Eigen/.*")
endforeach()
# The verification takes of trc what follows from the program alone, and the path that came out.
layer(core/verify "${known}|core/verify/.*|core/trc/((result|walls)/.*|state_archive\\.h)" "Eigen/.*")
foreach(folder trc nc/writer nc/convert verify session survey)
  string(APPEND known "|core/${folder}/.*")
  layer(core/${folder} "${known}" "Eigen/.*")
endforeach()

# The rooms of core/trc, each above those before it; the compensator stands above all of them.
string(REPLACE "|core/trc/.*" "|core/trc/(pass|path_block|setup|state_archive)\\.h" in_trc "${known}")
foreach(room result corner selection walls passes loops short_way)
  string(APPEND in_trc "|core/trc/${room}/.*")
  layer(core/trc/${room} "${in_trc}" "Eigen/.*")
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
