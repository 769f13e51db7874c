// The boundaries of cells, as a graph of junctions and arcs between pixels.
#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "tessera/voronoi/rasterizer.h"

namespace tessera {

inline constexpr int kOutside = -2;  // the label beyond the picture's border

// A pixel corner where three or four labels meet (the outside counting as one), or a corner of the picture.
struct Junction {
  int x = 0, y = 0;                               // corner: between pixel columns x - 1 and x, rows y - 1 and y
  std::array<int, 4> labels{};                    // of the pixels NW, NE, SE, SW
  std::array<int, 4> half_edges{-1, -1, -1, -1};  // leaving to E, S, W, N; -1: none
};

// The boundary between two labels from a junction to the next. Half-edge 2 k walks arc k from its first junction,
// half- edge 2 k + 1 back. Walking a half-edge, `label_right` of it is on the right (y down).
struct Arc {
  int from = 0, to = 0;
  int direction_from = 0;  // leaving `from`: 0 E, 1 S, 2 W, 3 N
  int direction_to = 0;    // leaving `to` backwards
  int left = 0, right = 0;
  int length = 0;  // in pixel sides
};

struct CellGraph {
  std::vector<Junction> junctions;
  std::vector<Arc> arcs;

  int head(int half_edge) const { return half_edge & 1 ? arcs[half_edge >> 1].from : arcs[half_edge >> 1].to; }
  int tail(int half_edge) const { return head(half_edge ^ 1); }
  int label_right(int half_edge) const {
    return half_edge & 1 ? arcs[half_edge >> 1].left : arcs[half_edge >> 1].right;
  }
  int label_left(int half_edge) const { return label_right(half_edge ^ 1); }
  // The next half-edge around the label on the right.
  int next(int half_edge) const;
};

// `labels` are connected cells without unlabelled pixels (connect_cells).
CellGraph trace_cells(const LabelMap& labels);

// The same, and the boundaries that meet no junction, of cells all around which is one other: each is an arc from a
// junction of its own, at the corner of the cell's first pixel in reading order, back to there. Such junctions come
// last. `cells`: labels are below.
CellGraph trace_cells_and_islands(const LabelMap& labels, int cells);

// The pixel corners along an arc, both junctions included.
std::vector<cv::Point> walk_arc(const CellGraph& graph, const LabelMap& labels, int arc);

// Half-edges along all of the boundary of each cell, in closed walks: the cell on the right, so that the walk around
// a cell is clockwise on the screen and those around what it encloses are not. By first half-edge; walks[cell].
std::vector<std::vector<std::vector<int>>> cell_walks(const CellGraph& graph, int cells);

// Half-edges around each cell, clockwise on the screen; none where a cell meets no junction.
struct CellRings {
  std::vector<int> first{0};  // where each cell's begin; one more at the end
  std::vector<int> half_edges;

  int cells() const { return static_cast<int>(first.size()) - 1; }
  std::span<const int> operator[](int cell) const {
    return std::span(half_edges).subspan(first[cell], first[cell + 1] - first[cell]);
  }
};

// A cell with more than one ring (one that encloses others) keeps the longest; its label is appended to `enclosing`.
CellRings cell_rings(const CellGraph& graph, int cells, std::vector<int>& enclosing);

// Cuts cells that enclose others in two, through the enclosed ones, until none does; new labels are appended and
// count in `cells`. Returns the boundaries. Call connect_cells first; the result is connected too.
CellGraph open_enclosures(LabelMap& labels, const cv::Mat1b& zones, int& cells);

}  // namespace tessera
