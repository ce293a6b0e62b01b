#include "server/rpc/resume_tokens.h"

#include <elf.h>
#include <fcntl.h>
#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>
#include <google/protobuf/message.h>
#include <link.h>
#include <openssl/crypto.h>
#include <openssl/evp.h>
#include <openssl/hmac.h>
#include <openssl/rand.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <istream>
#include <ostream>
#include <set>
#include <streambuf>

#include "core/base/archive.h"
#include "core/base/version.h"
#include "server/net/listener.h"

namespace trc::server {
namespace {

using Digest = ResumeTokens::Digest;

constexpr std::string_view format = "TRCR\x01";
constexpr std::size_t digest_bytes = std::tuple_size_v<Digest>;
constexpr std::size_t head_bytes = format.size() + 2 * digest_bytes;
constexpr std::size_t key_bytes = 32;
constexpr std::size_t longest_key = 4096;
constexpr std::size_t fewest_different_bytes = 8;

// The build id among ELF notes; empty: there is none.
std::string build_id_in(std::string_view notes) {
  while (notes.size() >= sizeof(ElfW(Nhdr))) {
    ElfW(Nhdr) head{};
    std::memcpy(&head, notes.data(), sizeof(head));
    const auto padded = [](std::size_t size) { return (size + 3) & ~std::size_t{3}; };
    const std::size_t begin = sizeof(head) + padded(head.n_namesz);
    if (notes.size() < begin + padded(head.n_descsz)) return {};
    if (head.n_type == NT_GNU_BUILD_ID) return std::string(notes.substr(begin, head.n_descsz));
    notes.remove_prefix(begin + padded(head.n_descsz));
  }
  return {};
}

// The build id that the linker has written into this program; random bytes if it has none, so that
// two such programs never accept each other's tokens.
std::string linker_build_id() {
  std::string id;
  const auto look = [](dl_phdr_info* program, std::size_t /*size*/, void* found) {
    std::string& result = *static_cast<std::string*>(found);
    for (int i = 0; i < program->dlpi_phnum && result.empty(); ++i) {
      const auto& part = program->dlpi_phdr[i];
      if (part.p_type == PT_NOTE)
        result = build_id_in(
            {std::bit_cast<const char*>(program->dlpi_addr + part.p_vaddr), part.p_memsz});
    }
    return 1;  // the program itself comes first
  };
  dl_iterate_phdr(look, &id);
  if (id.empty()) {
    id.resize(digest_bytes);
    RAND_bytes(reinterpret_cast<unsigned char*>(id.data()), static_cast<int>(id.size()));
  }
  return id;
}

std::string_view text_of(const Digest& digest) {
  return {reinterpret_cast<const char*>(digest.data()), digest.size()};
}

Digest sha256(std::string_view text) {
  Digest digest{};
  EVP_Digest(text.data(), text.size(), digest.data(), nullptr, EVP_sha256(), nullptr);
  return digest;
}

Digest mac_of(std::string_view text, const std::string& key) {
  Digest mac{};
  HMAC(EVP_sha256(), key.data(), static_cast<int>(key.size()),
       reinterpret_cast<const unsigned char*>(text.data()), text.size(), mac.data(), nullptr);
  return mac;
}

// The state of a session differs between releases, and also between commits. Without a known
// commit, outside of a clone, the build id of the linker takes its place.
const Digest& build_digest() {
  static const Digest digest = sha256(std::string(version()) + "+" + std::string(commit()) +
                                      (commit() == "unknown" ? linker_build_id() : ""));
  return digest;
}

// Fails after `most_bytes`, so that the attempt costs little when a session holds much.
class BoundedBuffer : public std::streambuf {
 public:
  explicit BoundedBuffer(std::size_t most_bytes) : most_bytes_(most_bytes) {}
  [[nodiscard]] std::string& content() { return content_; }

 private:
  std::streamsize xsputn(const char* bytes, std::streamsize count) override {
    const auto size = static_cast<std::size_t>(count);
    if (size > most_bytes_ - content_.size()) return 0;
    content_.append(bytes, size);
    return count;
  }
  int_type overflow(int_type byte) override {
    const char c = traits_type::to_char_type(byte);
    return xsputn(&c, 1) == 1 ? byte : traits_type::eof();
  }

  std::size_t most_bytes_;
  std::string content_;
};

class ViewBuffer : public std::streambuf {
 public:
  explicit ViewBuffer(std::string_view text) {
    char* begin = const_cast<char*>(text.data());
    setg(begin, begin, begin + text.size());
  }
};

Ending refuse_token(std::string_view detail) {
  return refuse(Refusal::resume_token_invalid, detail, {{"field", "setup.resume_token"}});
}

}  // namespace

Digest ResumeTokens::digest_of(const google::protobuf::Message& setup) {
  std::string text;
  {
    google::protobuf::io::StringOutputStream stream(&text);
    google::protobuf::io::CodedOutputStream coded(&stream);
    coded.SetSerializationDeterministic(true);
    setup.SerializeToCodedStream(&coded);
  }
  return sha256(setup.GetTypeName() + '\n' + text);
}

std::string ResumeTokens::seal(const Digest& setup,
                               const std::function<void(StateWriter&)>& save) const {
  if (most_bytes_ < head_bytes + digest_bytes) return {};
  BoundedBuffer buffer(most_bytes_ - digest_bytes);
  std::ostream stream(&buffer);
  stream << format << text_of(build_digest()) << text_of(setup);
  try {
    StateWriter archive(stream);
    save(archive);
  } catch (const cereal::Exception&) {
    return {};
  }
  std::string& token = buffer.content();
  token += text_of(mac_of(token, key_));
  return std::move(token);
}

std::optional<Ending> ResumeTokens::open(std::string_view token, const Digest& setup,
                                         const std::function<void(StateReader&)>& load) const {
  if (token.size() < head_bytes + digest_bytes || !token.starts_with(format.substr(0, 4)))
    return refuse_token("it is none of this service");
  const std::string_view sealed = token.substr(0, token.size() - digest_bytes);
  const Digest mac = mac_of(sealed, key_);
  if (CRYPTO_memcmp(mac.data(), token.data() + sealed.size(), digest_bytes) != 0)
    return refuse_token("it was changed, or comes from a server with another resume-key-file");
  if (!token.starts_with(format) ||
      sealed.substr(format.size(), digest_bytes) != text_of(build_digest()))
    return refuse(Refusal::resume_token_of_other_version);
  if (sealed.substr(format.size() + digest_bytes, digest_bytes) != text_of(setup))
    return refuse(Refusal::resume_setup_differs, {}, {{"field", "setup"}});
  ViewBuffer buffer(sealed.substr(head_bytes));
  std::istream stream(&buffer);
  StateReader archive(stream);
  load(archive);
  return std::nullopt;
}

namespace {

std::string key_fault(const std::string& path, const std::string& what) {
  return "resume-key-file: '" + path + "' " + what;
}

// The fault of a key that would not protect anything; empty: none.
std::string fault_of_key(const std::string& path, const struct stat& file, const std::string& key) {
  if ((file.st_mode & (S_IWGRP | S_IWOTH)) != 0)
    return key_fault(path, "can be written by others than its owner; chmod 600");
  if (key.size() < key_bytes) return key_fault(path, "holds fewer than 32 bytes");
  // Random bytes have some thirty different values; hexadecimal digits have sixteen.
  if (std::set<char>(key.begin(), key.end()).size() < fewest_different_bytes)
    return key_fault(path, "holds no random bytes");
  return {};
}

// The key in the file; none: the file does not exist.
std::optional<ResumeKey> key_there(const std::string& path) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (!file.valid()) {
    const int why = errno;
    struct stat link {};
    // A dangling link exists as well, and would have to be replaced.
    if (why == ENOENT && lstat(path.c_str(), &link) != 0) return std::nullopt;
    return ResumeKey{.fault =
                         key_fault(path, std::string("cannot be read: ") + std::strerror(why))};
  }
  struct stat status {};
  if (fstat(file.number(), &status) != 0 || !S_ISREG(status.st_mode))
    return ResumeKey{.fault = key_fault(path, "is no file")};
  ResumeKey result;
  result.key.resize(longest_key);
  const ssize_t size = read(file.number(), result.key.data(), result.key.size());
  result.key.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
  result.fault = fault_of_key(path, status, result.key);
  return result;
}

}  // namespace

ResumeKey resume_key(const std::string& path) {
  if (!path.empty())
    if (auto there = key_there(path)) return std::move(*there);
  ResumeKey result;
  result.key.resize(key_bytes);
  if (RAND_bytes(reinterpret_cast<unsigned char*>(result.key.data()), key_bytes) != 1) {
    result.fault = "resume-key-file: no random numbers to make a key from";
    return result;
  }
  if (path.empty()) return result;

  // Written to a draft and linked into place: if several servers start at one time, one makes the
  // key and the others read it, never half of it. A process number in the name would not be unique:
  // in containers each server is number 1.
  std::string draft = path + ".XXXXXX";
  const Descriptor file(::mkostemp(draft.data(), O_CLOEXEC));
  const bool written =
      file.valid() && write(file.number(), result.key.data(), key_bytes) == key_bytes;
  const bool linked = written && link(draft.c_str(), path.c_str()) == 0;
  const int why = errno;
  if (file.valid()) unlink(draft.c_str());
  if (linked) return result;
  if (written && why == EEXIST)
    if (auto there = key_there(path)) return std::move(*there);
  result.fault = "resume-key-file: cannot make '" + path + "': " + std::strerror(why);
  return result;
}

}  // namespace trc::server
