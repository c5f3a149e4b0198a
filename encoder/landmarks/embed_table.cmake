# Writes a file's bytes as C++: cmake -DIN=landmarks.table -DOUT=built_in_table.cpp -P embed_table.cmake
file(READ ${IN} bytes HEX)
string(REGEX REPLACE "(..)" "0x\\1," bytes "${bytes}")
string(REGEX REPLACE "(................................................................................)" "\\1\n" bytes "${bytes}")
file(WRITE ${OUT} "#include \"encoder/landmarks/built_in_table.h\"

namespace {
constexpr std::uint8_t kBytes[] = {
${bytes}};
}  // namespace

std::span<const std::uint8_t> fbs::built_in_landmark_table() {
  return kBytes;
}
")
