// XML, stepped over piece by piece without a library: nothing is expanded, so that hostile files cost no more than
// one pass over their bytes.
#pragma once

#include <optional>
#include <string_view>

namespace tessera {

struct MarkupPiece {
  enum class Kind { kText, kCharacterData, kTag };
  Kind kind;
  std::string_view text;  // as it stands there; of a tag what is between < and >

  bool is_closing() const { return kind == Kind::kTag && !text.empty() && text.front() == '/'; }
  bool is_empty_element() const { return kind == Kind::kTag && !text.empty() && text.back() == '/'; }
  std::string_view local_name() const;  // of a tag: "metadata" of "svg:metadata id='a'"
};

class Markup {
 public:
  // The text outlives this.
  explicit Markup(std::string_view xml) : rest_(xml) {}

  // The next text, character data or tag; comments, instructions and declarations are left out. Nothing at the end,
  // or where what follows is not well-formed or declares entities.
  std::optional<MarkupPiece> next();
  bool is_at_end() const { return rest_.empty(); }

 private:
  std::optional<std::string_view> take_until(std::string_view end, std::size_t start);
  std::optional<std::string_view> take_tag();

  std::string_view rest_;
};

// The value of a tag's attribute, as it stands there; nothing where there is none.
std::optional<std::string_view> attribute_of(std::string_view tag, std::string_view name);

}  // namespace tessera
