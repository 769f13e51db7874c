#include "tessera/io/png_rows.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <system_error>
#include <utility>
#include <vector>

#include "tessera/base/colour.h"
#include "tessera/io/decoders.h"
#include "tessera/io/png_reader.h"

namespace tessera {
namespace {

constexpr int kMaxSide = 1 << 20;

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

void read_from_file(png_structp png, png_bytep out, std::size_t size) {
  if (std::fread(out, 1, size, static_cast<std::FILE*>(png_get_io_ptr(png))) != size) png_error(png, "cut short");
}

class PngRows : public RowSource {
 public:
  PngRows(std::string path, File file) : path_(std::move(path)), file_(std::move(file)) {}

  bool is_png() {
    png_byte head[8];
    return std::fread(head, 1, sizeof head, file_.get()) == sizeof head && png_sig_cmp(head, 0, sizeof head) == 0;
  }
  // After a rewind().
  bool comes_in_rows() { return !reader_->is_interlaced() && reader_->exif().orientation == 1; }

  cv::Size size() const override { return size_; }

  Result<void> rewind() override {
    std::rewind(file_.get());
    reader_ = std::make_unique<PngReader>(file_.get(), read_from_file);
    next_ = 0;
    if (!reader_->read_header(false)) return broken();
    if (reader_->width() > kMaxSide || reader_->height() > kMaxSide)
      return fail(StatusCode::kInvalidInput, path_,
                  fmt::format("is {} x {} px, expected sides of at most {} px", reader_->width(), reader_->height(),
                              kMaxSide));
    size_ = {static_cast<int>(reader_->width()), static_cast<int>(reader_->height())};
    return {};
  }

  Result<void> read(int rows, std::uint8_t* pixels) override {
    const std::size_t width = static_cast<std::size_t>(size_.width), stride = 3 * width;
    const bool has_alpha = reader_->channels() == 4;
    if (has_alpha) row_.resize(4 * width);
    for (int y = 0; y < rows; ++y, pixels += stride) {
      if (!reader_->read_rows(has_alpha ? row_.data() : pixels, stride, 1)) return broken();
      if (!has_alpha) continue;
      for (std::size_t x = 0; x < width; ++x)
        for (std::size_t c = 0; c < 3; ++c) pixels[3 * x + c] = over_white(row_[4 * x + c], row_[4 * x + 3]);
    }
    next_ += rows;
    if (next_ == size_.height && !reader_->read_end()) return broken();
    return {};
  }

 private:
  tl::unexpected<Status> broken() const {
    return fail(StatusCode::kInvalidInput, path_, damaged("PNG", reader_->message()).value().message);
  }

  std::string path_;
  File file_;
  std::unique_ptr<PngReader> reader_;
  cv::Size size_;
  int next_ = 0;
  std::vector<std::uint8_t> row_;
};

}  // namespace

Result<std::unique_ptr<RowSource>> open_png_rows(const std::string& path) {
  File file(std::fopen(path.c_str(), "rbe"));
  if (!file)
    return fail(StatusCode::kInvalidInput, path, "cannot be opened: " + std::generic_category().message(errno));
  auto rows = std::make_unique<PngRows>(path, std::move(file));
  if (!rows->is_png()) return std::unique_ptr<RowSource>();
  if (auto begun = rows->rewind(); !begun) return tl::unexpected<Status>(std::move(begun.error()));
  if (!rows->comes_in_rows()) return std::unique_ptr<RowSource>();
  return std::unique_ptr<RowSource>(std::move(rows));
}

}  // namespace tessera
