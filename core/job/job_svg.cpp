// Finds the job inside an SVG; nothing is expanded but XML's own entities.
#include <cstdint>
#include <optional>

#include "tessera/job/job_json.h"
#include "tessera/job/markup.h"

namespace tessera {
namespace {

tl::unexpected<Status> no_job(const char* why) {
  return fail(StatusCode::kInvalidInput, "", std::string(why) + ", expected an SVG with its job in <metadata>");
}

bool append_utf8(std::uint32_t code, std::string& out) {
  if (code == 0 || code > 0x10FFFF || (code >= 0xD800 && code <= 0xDFFF)) return false;
  const auto tail = [&](int shift) { out += static_cast<char>(0x80 | ((code >> shift) & 0x3F)); };
  if (code < 0x80) {
    out += static_cast<char>(code);
  } else if (code < 0x800) {
    out += static_cast<char>(0xC0 | (code >> 6));
    tail(0);
  } else if (code < 0x10000) {
    out += static_cast<char>(0xE0 | (code >> 12));
    tail(6), tail(0);
  } else {
    out += static_cast<char>(0xF0 | (code >> 18));
    tail(12), tail(6), tail(0);
  }
  return true;
}

// The number of "#65" or "#x41"; 0 where it is none.
std::uint32_t character_reference(std::string_view name) {
  const bool hex = name.size() > 1 && name[1] == 'x';
  const std::string_view digits = name.substr(hex ? 2 : 1);
  if (digits.empty() || digits.size() > 7) return 0;
  std::uint32_t code = 0;
  for (const char c : digits) {
    const char lower = static_cast<char>(c | 0x20);
    const bool is_digit = c >= '0' && c <= '9', is_hex = hex && lower >= 'a' && lower <= 'f';
    if (!is_digit && !is_hex) return 0;
    code = code * (hex ? 16 : 10) + static_cast<std::uint32_t>(is_digit ? c - '0' : lower - 'a' + 10);
  }
  return code;
}

bool append_entity(std::string_view name, std::string& out) {
  struct Named {
    std::string_view name;
    char character;
  };
  static constexpr Named kNamed[] = {{"lt", '<'}, {"gt", '>'}, {"amp", '&'}, {"quot", '"'}, {"apos", '\''}};
  for (const Named& entity : kNamed) {
    if (entity.name == name) {
      out += entity.character;
      return true;
    }
  }
  return !name.empty() && name[0] == '#' && append_utf8(character_reference(name), out);
}

bool append_unescaped(std::string_view text, std::string& out) {
  while (!text.empty()) {
    const std::size_t plain = std::min(text.find('&'), text.size());
    out += text.substr(0, plain);
    text.remove_prefix(plain);
    if (text.empty()) break;
    const std::size_t end = text.substr(0, 12).find(';');
    if (end == std::string_view::npos || !append_entity(text.substr(1, end - 1), out)) return false;
    text.remove_prefix(end + 1);
  }
  return true;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

class MetadataFinder {
 public:
  explicit MetadataFinder(std::string_view svg) : markup_(svg) {}

  Result<std::string> find() {
    using Kind = MarkupPiece::Kind;
    while (const auto piece = markup_.next()) {
      if (depth_ == 1 && piece->kind == Kind::kCharacterData) job_ += piece->text;
      if (depth_ == 1 && piece->kind == Kind::kText && !append_unescaped(piece->text, job_))
        return no_job("has an unknown entity");
      if (job_.size() > kMaxJobBytes) return no_job("has too long a <metadata>");
      if (piece->kind == Kind::kTag) count_tag(*piece);
      if (found_) return *std::move(found_);
    }
    return no_job(markup_.is_at_end() ? "holds no job" : "is not well-formed XML");
  }

 private:
  // Keeps count of how deep below a <metadata> the text is; its own text, and no child's, may be the job.
  void count_tag(const MarkupPiece& tag) {
    if (tag.is_closing() && depth_ > 0 && --depth_ == 0) {
      if (const std::string_view job = trimmed(job_); !job.empty() && job.front() == '{') found_ = std::string(job);
      job_.clear();
    } else if (!tag.is_closing() && !tag.is_empty_element() && (depth_ > 0 || tag.local_name() == "metadata")) {
      ++depth_;
    }
  }

  Markup markup_;
  int depth_ = 0;  // 0: outside, 1: directly in a <metadata>
  std::string job_;
  std::optional<std::string> found_;
};

}  // namespace

Result<std::string> extract_job_from_svg(std::string_view svg) { return MetadataFinder(svg).find(); }

}  // namespace tessera
