#include "framework/report/page.h"

#include <bit>

#include "framework/common/sha256.h"
#include "framework/report/page_parts.h"

namespace pintle {

namespace {

static_assert(std::endian::native == std::endian::little, "pages need a little-endian machine");

template <class Number>
std::string base64_of(std::span<const Number> x) {
  return base64(std::string_view(reinterpret_cast<const char*>(x.data()), x.size_bytes()));
}

std::string bytes_of_hex(const std::string& hex) {
  std::string out;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2) out += static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16));
  return out;
}

void replace_all(std::string& text, std::string_view what, std::string_view with) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += with.size()) text.replace(at, what.size(), with);
}

}  // namespace

std::string html_text(std::string_view text) {
  std::string out;
  for (const char c : text) switch (c) {
      case '&': out += "&amp;"; break;
      case '<': out += "&lt;"; break;
      case '>': out += "&gt;"; break;
      case '"': out += "&quot;"; break;
      case '\'': out += "&#39;"; break;
      default: out += c;
    }
  return out;
}

std::string json_in_script(std::string json) {
  replace_all(json, "<", "\\u003c");
  return json;
}

std::string base64(std::string_view bytes) {
  static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k) out += i + k > bytes.size() ? '=' : digits[group >> (18 - 6 * k) & 63U];
  }
  return out;
}
std::string base64(std::span<const double> x) { return base64_of(x); }
std::string base64(std::span<const float> x) { return base64_of(x); }
std::string base64(std::span<const int> x) { return base64_of(x); }

std::string page(const std::string& title, std::string json) {
  const std::string script_sum = base64(bytes_of_hex(sha256(page_parts::script)));
  std::string out = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n";
  out +=
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src "
      "'sha256-" +
      script_sum + "'\">\n";
  out += "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" + html_text(title) + "</title>\n<style>\n";
  out.append("/* uPlot, here and in the script:\n\n").append(page_parts::notice).append("*/\n");
  out.append(page_parts::style).append("</style>\n</head>\n<body>\n").append(page_parts::body);
  out.append("<script type=\"application/json\" id=\"data\">").append(json_in_script(std::move(json))).append("</script>\n<script>");
  return out.append(page_parts::script).append("</script>\n</body>\n</html>\n");
}

}  // namespace pintle
