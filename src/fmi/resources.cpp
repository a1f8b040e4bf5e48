#include "fmi/resources.hpp"

#include <cctype>
#include <cstdio>
#include <memory>
#include <string_view>

#ifdef _WIN32
#include <windows.h>
#endif

namespace floatframe::fmi {
namespace {

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  const int letter = std::tolower(static_cast<unsigned char>(c));
  return letter >= 'a' && letter <= 'f' ? letter - 'a' + 10 : -1;
}

/// RFC 3986, section 2.1; a '%' that begins no number stays.
std::string percent_decoded(std::string_view text) {
  std::string plain;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const int high = text[k] == '%' && k + 2 < text.size() ? hex_digit(text[k + 1]) : -1;
    const int low = high >= 0 ? hex_digit(text[k + 2]) : -1;
    if (low >= 0) {
      plain += static_cast<char>(16 * high + low);
      k += 2;
    } else {
      plain += text[k];
    }
  }
  return plain;
}

/// Of "/C:/folder" what Windows calls C:/folder.
bool names_a_drive(std::string_view path) {
  return path.size() > 2 && path[0] == '/' &&
         std::isalpha(static_cast<unsigned char>(path[1])) != 0 && path[2] == ':';
}

bool begins_with_file(std::string_view text) {
  const std::string_view scheme = "file:";
  if (text.size() < scheme.size()) return false;
  for (std::size_t k = 0; k < scheme.size(); ++k)
    if (std::tolower(static_cast<unsigned char>(text[k])) != scheme[k]) return false;
  return true;
}

std::FILE* open_for_reading(const std::string& path) {
#ifdef _WIN32
  const int length = MultiByteToWideChar(CP_UTF8, 0, path.c_str(), -1, nullptr, 0);
  std::wstring wide(length > 0 ? std::size_t(length) : 1, L'\0');
  MultiByteToWideChar(CP_UTF8, 0, path.c_str(), -1, wide.data(), length);
  return _wfopen(wide.c_str(), L"rb");
#else
  return std::fopen(path.c_str(), "rb");
#endif
}

}  // namespace

std::string model_path(const std::string& resources) {
  std::string folder = resources;
  if (begins_with_file(resources)) {
    std::string_view rest = std::string_view(resources).substr(5);
    if (rest.substr(0, 2) == "//") {  // an authority: none or this computer
      rest.remove_prefix(2);
      const std::size_t slash = rest.find('/');
      if (slash == std::string_view::npos) return {};
      const std::string_view host = rest.substr(0, slash);
      const bool drive = host.size() == 2 && host[1] == ':';  // file://C:/folder, which some write
      if (!host.empty() && host != "localhost" && !drive) return {};
      if (!drive) rest.remove_prefix(slash);
    }
    folder = percent_decoded(rest);
    if (names_a_drive(folder)) folder.erase(0, 1);
  } else if (resources.find("://") != std::string::npos) {
    return {};
  }
  if (folder.empty()) return {};
  if (folder.back() != '/' && folder.back() != '\\') folder += '/';
  return folder + "model.ffm";
}

bool read_file(const std::string& path, std::vector<unsigned char>& bytes) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(open_for_reading(path), &std::fclose);
  if (!file) return false;
  bytes.clear();
  std::size_t count = 0;
  do {
    const std::size_t size = bytes.size();
    bytes.resize(size + (1u << 20));
    count = std::fread(bytes.data() + size, 1, bytes.size() - size, file.get());
    bytes.resize(size + count);
  } while (count > 0);
  return std::ferror(file.get()) == 0;
}

}  // namespace floatframe::fmi
