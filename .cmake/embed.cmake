# Makes a C++ source of the files of the page: cmake -D DIR=client/page -D OUT=file.cpp -P embed.cmake
file(GLOB files "${DIR}/*.html" "${DIR}/*.css" "${DIR}/*.js")
list(SORT files)
list(LENGTH files count)
set(text "")
set(rows "")
set(number 0)
foreach(file IN LISTS files)
  get_filename_component(name "${file}" NAME)
  file(READ "${file}" bytes HEX)
  # Lines of 32 bytes; each byte is written the same way, so that no digit joins the one before.
  string(REGEX REPLACE "(................................................................)" "\\1\n"
    bytes "${bytes}")
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "\\\\x\\1" bytes "${bytes}")
  string(REGEX REPLACE "([^\n]+)\n?" "    \"\\1\"\n" bytes "${bytes}")
  string(APPEND text "constexpr char file_${number}[] =\n${bytes};\n")
  string(APPEND rows "    {\"${name}\", {file_${number}, sizeof file_${number} - 1}},\n")
  math(EXPR number "${number} + 1")
endforeach()
file(WRITE "${OUT}" "#include \"server/http/page.h\"\n\n#include <array>\n\n"
  "namespace trc::server::http {\nnamespace {\n\n${text}"
  "constexpr std::array<PageFile, ${count}> files{{\n${rows}}};\n\n}  // namespace\n\n"
  "std::span<const PageFile> page_files() { return files; }\n\n}  // namespace trc::server::http\n")
