// A picture that comes row after row, for those too large for memory.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <cstring>
#include <opencv2/core.hpp>
#include <utility>

#include "tessera/base/status.h"
#include "tessera/image/image_view.h"

namespace tessera {

class RowSource {
 public:
  virtual ~RowSource() = default;
  virtual cv::Size size() const = 0;  // at least 1 x 1
  // The next read() begins at the first row.
  virtual Result<void> rewind() = 0;
  // The next rows of pixels as an ImageView has them, without gaps; there are so many left. Errors are those of the
  // picture: kInvalidInput.
  virtual Result<void> read(int rows, std::uint8_t* pixels) = 0;
};

// Those of a picture in memory, which is read during the calls.
class RowsOfView : public RowSource {
 public:
  explicit RowsOfView(const ImageView& view) : view_(view) {}
  cv::Size size() const override { return {view_.width, view_.height}; }
  Result<void> rewind() override {
    next_ = 0;
    return {};
  }
  Result<void> read(int rows, std::uint8_t* pixels) override {
    const std::size_t bytes = std::size_t{3} * static_cast<std::size_t>(view_.width);
    for (int end = next_ + rows; next_ < end; ++next_, pixels += bytes)
      std::memcpy(pixels, view_.pixels + next_ * view_.stride, bytes);
    return {};
  }

 private:
  ImageView view_;
  int next_ = 0;
};

// The rows of a picture that are at hand, some of its height; they move down.
class RowWindow {
 public:
  // Holds up to `most` rows.
  RowWindow(RowSource& source, int most)
      : source_(source), rows_(std::min(most, source.size().height), source.size().width) {}

  Result<void> rewind() {
    begin_ = end_ = 0;
    return source_.rewind();
  }

  // Has rows [begin, end) at hand and forgets those before; both never fall and are cut off at the picture's end.
  Result<void> show(int begin, int end) {
    end = std::max(end_, std::min(end, source_.size().height));
    begin = std::clamp(begin, begin_, end_);
    assert(end - begin <= rows_.rows);
    if (begin > begin_)
      std::memmove(rows_.ptr(), rows_.ptr(begin - begin_), static_cast<std::size_t>(end_ - begin) * rows_.step[0]);
    begin_ = begin;
    const int first = std::exchange(end_, end);
    return first < end ? source_.read(end - first, rows_.ptr(first - begin)) : Result<void>{};
  }

  // A part of the picture, of rows that are at hand; in the window's memory, until the next show(). To OpenCV it is a
  // picture of its own, not a part of one, of which some filters would look at what is around it.
  cv::Mat3b part(cv::Rect where) const {
    const cv::Vec3b* first = &rows_(where.y - begin_, where.x);
    return {where.height, where.width, const_cast<cv::Vec3b*>(first), rows_.step[0]};
  }
  cv::Size size() const { return source_.size(); }

 private:
  RowSource& source_;
  cv::Mat3b rows_;
  int begin_ = 0, end_ = 0;
};

}  // namespace tessera
