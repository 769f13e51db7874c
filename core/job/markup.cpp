#include "tessera/job/markup.h"

#include <algorithm>

namespace tessera {
namespace {

constexpr std::string_view kBlank = " \t\r\n";

}  // namespace

std::string_view MarkupPiece::local_name() const {
  const std::string_view name = text.substr(is_closing() ? 1 : 0);
  const std::string_view word = name.substr(0, name.find_first_of(" \t\r\n/"));
  const std::size_t colon = word.find(':');
  return colon == std::string_view::npos ? word : word.substr(colon + 1);
}

std::optional<MarkupPiece> Markup::next() {
  using Kind = MarkupPiece::Kind;
  while (!rest_.empty()) {
    if (rest_.front() != '<') {
      const std::string_view text = rest_.substr(0, rest_.find('<'));
      rest_.remove_prefix(text.size());
      return MarkupPiece{Kind::kText, text};
    }
    if (rest_.substr(0, 4) == "<!--") {
      if (!take_until("-->", 4)) return std::nullopt;
    } else if (rest_.substr(0, 2) == "<?") {
      if (!take_until("?>", 2)) return std::nullopt;
    } else if (rest_.substr(0, 9) == "<![CDATA[") {
      const auto text = take_until("]]>", 9);
      if (!text) return std::nullopt;
      return MarkupPiece{Kind::kCharacterData, *text};
    } else if (rest_.substr(0, 2) == "<!") {
      const std::string_view before = rest_;
      const auto declaration = take_until(">", 2);
      if (!declaration) return std::nullopt;
      if (declaration->find('[') != std::string_view::npos) {
        rest_ = before;
        return std::nullopt;
      }
    } else {
      const auto tag = take_tag();
      if (!tag) return std::nullopt;
      return MarkupPiece{Kind::kTag, *tag};
    }
  }
  return std::nullopt;
}

std::optional<std::string_view> Markup::take_until(std::string_view end, std::size_t start) {
  const std::size_t at = rest_.find(end, start);
  if (at == std::string_view::npos) return std::nullopt;
  const std::string_view inside = rest_.substr(start, at - start);
  rest_.remove_prefix(at + end.size());
  return inside;
}

// A > within quotes does not end it.
std::optional<std::string_view> Markup::take_tag() {
  char quote = 0;
  for (std::size_t i = 1; i < rest_.size(); ++i) {
    const char c = rest_[i];
    if (quote) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '>') {
      const std::string_view tag = rest_.substr(1, i - 1);
      rest_.remove_prefix(i + 1);
      return tag;
    }
  }
  return std::nullopt;
}

std::optional<std::string_view> attribute_of(std::string_view tag, std::string_view name) {
  for (std::size_t at = tag.find_first_of(kBlank); at != std::string_view::npos;) {
    at = tag.find_first_not_of(kBlank, at);
    const std::size_t equals = at == std::string_view::npos ? at : tag.find('=', at);
    if (equals == std::string_view::npos) return std::nullopt;
    std::string_view word = tag.substr(at, equals - at);
    word = word.substr(0, std::min(word.find_first_of(kBlank), word.size()));
    const std::size_t open = tag.find_first_of("\"'", equals);
    if (open == std::string_view::npos) return std::nullopt;
    const std::size_t close = tag.find(tag[open], open + 1);
    if (close == std::string_view::npos) return std::nullopt;
    if (word == name) return tag.substr(open + 1, close - open - 1);
    at = close + 1 < tag.size() ? close + 1 : std::string_view::npos;
  }
  return std::nullopt;
}

}  // namespace tessera
