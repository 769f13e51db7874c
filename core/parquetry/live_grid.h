// The morphed grid of a job while people work on it (3.4: "real-time grid morphing").
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tessera/base/status.h"
#include "tessera/parquetry/edge_picture.h"
#include "tessera/parquetry/morphing_grid.h"
#include "tessera/parquetry/params.h"

namespace tessera::parquetry {

// Relaxes step by step, and while a vertex is dragged. Where that vertex is let go, the grid becomes the one that a
// job with its pins makes: what is seen then is what will be cut.
class LiveGrid {
 public:
  // `target`: at the panels' resolution. Looks for its edges, which takes the longest.
  LiveGrid(cv::Mat3b target, const Params& params, double mm_per_px);
  LiveGrid(const LiveGrid&) = delete;
  LiveGrid& operator=(const LiveGrid&) = delete;

  // Whether begin() may be called for these: the edges are the same.
  bool is_of(const cv::Mat3b& target, const Params& params, double mm_per_px) const;

  // Even, about to relax. Fails as morphing_grid_of(), and is then as it was before.
  Result<void> begin(const Params& params, const EdgeMasks& masks);

  // The following need a begin() that went well.
  const MorphingGrid& grid() const { return *grid_; }
  cv::Size size() const { return target_.size(); }  // px
  double mm_per_px() const { return mm_per_px_; }
  const FoundEdges& found() const { return found_; }  // before masks, and after:
  const FoundEdges& counting() const { return counting_; }

  // At most so many steps; none are left where it is at rest. How many there were.
  int step(int most);
  // Draws a vertex of the grid towards a place, mm, as the following steps go; those pinned before stay pinned.
  void drag(int column, int row, Point mm);
  // Lets the dragged vertex go where it is, or as near to there as a job can have it: the pins of that job. The grid
  // is at rest as the job will have it. Nothing changes where no vertex was dragged, or its place cannot be kept.
  std::string lay();

 private:
  struct Dragged {
    int column, row;
    std::vector<Point> before;  // all vertices
  };
  std::vector<Point> vertices() const;
  Result<void> restart();
  bool hold(std::vector<Pin> pins, const std::vector<Point>& before);

  cv::Mat3b target_;
  double mm_per_px_;
  FoundEdges found_, counting_;
  Params params_;
  std::unique_ptr<const EdgePicture> edges_;
  std::optional<MorphingGrid> grid_;
  std::optional<Dragged> dragged_;
};

}  // namespace tessera::parquetry
