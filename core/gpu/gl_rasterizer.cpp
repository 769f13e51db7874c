#include "tessera/gpu/gl_rasterizer.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <optional>

#include "shaders.h"
#include "tessera/gpu/gl_object.h"
#include "tessera/gpu/site_batch.h"
#include "tessera/gpu/site_mesh.h"

namespace tessera {
namespace {

static_assert(std::endian::native == std::endian::little, "labels are read back as bytes, least significant first");

constexpr int kSegments = 8;                // facets of a quarter cone; more only take time, see settle.frag
constexpr std::size_t kSitesPerRow = 1024;  // two texels each: no wider than any driver allows
constexpr std::size_t kMostSites = 1 << 24;
constexpr double kFarthest = 1e18;  // its square is finite in single precision
constexpr GLuint kNoSlot = 0xffffffff;

// A part of the canvas. `area` is drawn: the `core` that is read back and the neighbours of its pixels.
struct Tile {
  cv::Rect core, area;
};

std::vector<Tile> split(const cv::Size& canvas, int limit) {
  const auto step = [&](int length) { return length <= limit ? length : limit - 2; };
  const cv::Rect all({}, canvas);
  std::vector<Tile> tiles;
  for (int y = 0; y < canvas.height; y += step(canvas.height)) {
    for (int x = 0; x < canvas.width; x += step(canvas.width)) {
      const cv::Rect core = cv::Rect(x, y, step(canvas.width), step(canvas.height)) & all;
      tiles.push_back({core, cv::Rect(core.x - 1, core.y - 1, core.width + 2, core.height + 2) & all});
    }
  }
  return tiles;
}

// Where a tile is drawn.
struct Targets {
  cv::Size size;
  gl::Texture zones;                 // R8UI
  gl::Texture slots;                 // R32UI, the nearest site's slot as the depth test finds it
  gl::Renderbuffer depth_and_zones;  // the stencil repeats the zones
  gl::Renderbuffer labels;           // RGBA8
  gl::Framebuffer slots_frame, labels_frame;

  static Result<Targets> allocate(const cv::Size& size);
};

void allocate_texture(const gl::Texture& texture, GLenum format, const cv::Size& size) {
  glBindTexture(GL_TEXTURE_2D, texture.id());
  glTexStorage2D(GL_TEXTURE_2D, 1, format, size.width, size.height);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

void allocate_renderbuffer(const gl::Renderbuffer& buffer, GLenum format, const cv::Size& size) {
  glBindRenderbuffer(GL_RENDERBUFFER, buffer.id());
  glRenderbufferStorage(GL_RENDERBUFFER, format, size.width, size.height);
}

Result<Targets> Targets::allocate(const cv::Size& size) {
  const std::string what =
      "a framebuffer of " + std::to_string(size.width) + "x" + std::to_string(size.height) + " px";
  Targets t;
  t.size = size;
  allocate_texture(t.zones, GL_R8UI, size);
  allocate_texture(t.slots, GL_R32UI, size);
  allocate_renderbuffer(t.depth_and_zones, GL_DEPTH32F_STENCIL8, size);
  allocate_renderbuffer(t.labels, GL_RGBA8, size);
  glBindFramebuffer(GL_FRAMEBUFFER, t.slots_frame.id());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, t.slots.id(), 0);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER, t.depth_and_zones.id());
  if (Result<void> complete = gl::check_framebuffer(what); !complete) return tl::unexpected(complete.error());
  glBindFramebuffer(GL_FRAMEBUFFER, t.labels_frame.id());
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, t.labels.id());
  if (Result<void> complete = gl::check_framebuffer(what); !complete) return tl::unexpected(complete.error());
  if (Result<void> errors = gl::check(what); !errors) return tl::unexpected(errors.error());
  return t;
}

struct Programs {
  gl::Program site, zone, settle;

  static Result<Programs> build() {
    auto site = gl::Program::build("site", shaders::kSiteVert, shaders::kSiteFrag);
    if (!site) return tl::unexpected(site.error());
    auto zone = gl::Program::build("zone", shaders::kScreenVert, shaders::kZoneFrag);
    if (!zone) return tl::unexpected(zone.error());
    auto settle = gl::Program::build("settle", shaders::kScreenVert, shaders::kSettleFrag);
    if (!settle) return tl::unexpected(settle.error());
    return Programs{std::move(*site), std::move(*zone), std::move(*settle)};
  }
};

void use_texture(const gl::Program& program, const char* name, int unit, const gl::Texture& texture) {
  glActiveTexture(GL_TEXTURE0 + unit);
  glBindTexture(GL_TEXTURE_2D, texture.id());
  glUniform1i(program.uniform(name), unit);
}

const void* offset(std::size_t bytes) { return reinterpret_cast<const void*>(bytes); }

class GlRasterizer : public Rasterizer {
 public:
  GlRasterizer(Programs programs, int tile_limit) : programs_(std::move(programs)), tile_limit_(tile_limit) {}

  std::string_view name() const override { return "gl"; }
  Result<void> begin(const cv::Mat1b& zones, Metric metric, double reach) override;
  Result<void> label(const Sites& sites, LabelMap& labels) override;

 private:
  void upload_mesh();
  void upload_sites(SiteBatch& batch);
  void begin_tile(const Tile& tile) const;
  void fill_stencil(const Tile& tile) const;
  void draw_sites(const SiteBatch& batch) const;
  void settle() const;
  void read(const Tile& tile, LabelMap& labels) const;
  void draw_screen() const;

  Programs programs_;
  int tile_limit_;
  gl::VertexArray site_array_, screen_array_;
  gl::Buffer mesh_vertices_, mesh_triangles_, instances_;
  gl::Texture sites_;

  // Of the canvas.
  cv::Mat1b zones_;
  Metric metric_ = Metric::kFrustum;
  double reach_ = 0;
  SiteMesh mesh_;
  std::vector<Tile> tiles_;
  int viewport_ = 0;  // its side, px: a power of two, so that pixels survive the way to GL's coordinates unrounded
  std::optional<Targets> targets_;
  const Tile* filled_ = nullptr;  // the tile whose zones the targets hold
};

Result<void> GlRasterizer::begin(const cv::Mat1b& zones, Metric metric, double reach) {
  assert(reach >= 0);
  zones_ = zones;
  metric_ = metric;
  reach_ = reach;
  filled_ = nullptr;
  tiles_ = split(zones.size(), tile_limit_);
  upload_mesh();
  const cv::Size size(std::min(zones.cols, tile_limit_), std::min(zones.rows, tile_limit_));
  viewport_ = static_cast<int>(std::bit_ceil(static_cast<unsigned>(std::max(size.width, size.height))));
  if (size.empty() || (targets_ && targets_->size == size)) return gl::check("uploading the template of a site");
  targets_.reset();  // before the new ones, which may need its memory
  Result<Targets> targets = Targets::allocate(size);
  if (!targets) return tl::unexpected(targets.error());
  targets_.emplace(std::move(*targets));
  return {};
}

Result<void> GlRasterizer::label(const Sites& sites, LabelMap& labels) {
  if (sites.size() > kMostSites) return fail(StatusCode::kInternal, "", "OpenGL: more than 2^24 sites");
  assert(targets_ || tiles_.empty());
  labels.create(zones_.size());
  for (const Tile& tile : tiles_) {
    SiteBatch batch = gather_sites(sites, metric_, reach_, tile.area);
    begin_tile(tile);
    if (auto usable = gl::check_framebuffer("beginning to draw"); !usable) return usable;
    if (filled_ != &tile) fill_stencil(tile);
    if (auto filled = gl::check("drawing the zones"); !filled) return filled;
    filled_ = &tile;
    upload_sites(batch);
    if (auto uploaded = gl::check("uploading " + std::to_string(sites.size()) + " sites"); !uploaded) return uploaded;
    draw_sites(batch);
    settle();
    if (auto drawn = gl::check("drawing the sites"); !drawn) return drawn;
    read(tile, labels);
    if (auto done = gl::check("reading the labels back"); !done) return done;
  }
  return {};
}

void GlRasterizer::upload_mesh() {
  mesh_ = site_mesh(metric_, kSegments);
  glBindVertexArray(site_array_.id());
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, mesh_triangles_.id());
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, mesh_.triangles.size() * sizeof(std::uint16_t), mesh_.triangles.data(),
               GL_STATIC_DRAW);
  glBindBuffer(GL_ARRAY_BUFFER, mesh_vertices_.id());
  glBufferData(GL_ARRAY_BUFFER, mesh_.vertices.size() * sizeof(MeshVertex), mesh_.vertices.data(), GL_STATIC_DRAW);
  const auto attribute = [](GLuint location, int size, std::size_t at) {
    glEnableVertexAttribArray(location);
    glVertexAttribPointer(location, size, GL_FLOAT, GL_FALSE, sizeof(MeshVertex), offset(at));
  };
  attribute(0, 2, offsetof(MeshVertex, corner_u));
  attribute(1, 2, offsetof(MeshVertex, direction_u));
  attribute(2, 1, offsetof(MeshVertex, level));
  for (const GLuint location : {3, 4}) {
    glEnableVertexAttribArray(location);
    glVertexAttribDivisor(location, 1);
  }
}

// The same bytes twice: as attributes for drawing, as a texture for settling.
void GlRasterizer::upload_sites(SiteBatch& batch) {
  glBindBuffer(GL_ARRAY_BUFFER, instances_.id());
  glBufferData(GL_ARRAY_BUFFER, batch.records.size() * sizeof(SiteRecord), batch.records.data(), GL_STREAM_DRAW);

  const std::size_t rows = batch.records.size() / kSitesPerRow + 1;
  batch.records.resize(rows * kSitesPerRow);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, sites_.id());
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, 2 * kSitesPerRow, static_cast<GLsizei>(rows), 0, GL_RGBA, GL_FLOAT,
               batch.records.data());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

void GlRasterizer::begin_tile(const Tile& tile) const {
  glBindFramebuffer(GL_FRAMEBUFFER, targets_->slots_frame.id());
  glViewport(0, 0, viewport_, viewport_);
  glScissor(0, 0, tile.area.width, tile.area.height);
  for (const GLenum capability : {GL_BLEND, GL_CULL_FACE, GL_DITHER, GL_POLYGON_OFFSET_FILL, GL_RASTERIZER_DISCARD,
                                  GL_SAMPLE_ALPHA_TO_COVERAGE, GL_SAMPLE_COVERAGE})
    glDisable(capability);
  glStencilMask(0xff);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_LESS);
  glDepthRangef(0, 1);
}

// Begins with the first pixel's zone everywhere and flips, bit by bit, where others differ.
void GlRasterizer::fill_stencil(const Tile& tile) const {
  const cv::Mat1b zones = zones_(tile.area);
  const int base = zones(0, 0);
  int differing = 0;
  for (int y = 0; y < zones.rows; ++y)
    for (int x = 0; x < zones.cols; ++x) differing |= zones(y, x) ^ base;

  programs_.zone.use();
  use_texture(programs_.zone, "zones", 0, targets_->zones);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, static_cast<GLint>(zones.step1()));
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, zones.cols, zones.rows, GL_RED_INTEGER, GL_UNSIGNED_BYTE, zones.ptr());

  glDisable(GL_SCISSOR_TEST);
  glClearBufferiv(GL_STENCIL, 0, &base);
  glEnable(GL_SCISSOR_TEST);
  glDisable(GL_DEPTH_TEST);
  glEnable(GL_STENCIL_TEST);
  glStencilFunc(GL_ALWAYS, 0, 0xff);
  glStencilOp(GL_KEEP, GL_KEEP, GL_INVERT);
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  glUniform1ui(programs_.zone.uniform("base"), static_cast<GLuint>(base));
  for (unsigned bit = 1; bit < 256; bit <<= 1) {
    if ((differing & bit) == 0) continue;
    glStencilMask(bit);
    glUniform1ui(programs_.zone.uniform("mask"), bit);
    draw_screen();
  }
  glStencilMask(0xff);
}

// One draw a zone, in the order of slots: of equal depths the first stays.
void GlRasterizer::draw_sites(const SiteBatch& batch) const {
  const GLuint none[4] = {kNoSlot, kNoSlot, kNoSlot, kNoSlot};
  const float farthest = 1;
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDisable(GL_SCISSOR_TEST);
  glClearBufferuiv(GL_COLOR, 0, none);
  glClearBufferfv(GL_DEPTH, 0, &farthest);
  glEnable(GL_SCISSOR_TEST);
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_STENCIL_TEST);
  glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);

  const gl::Program& program = programs_.site;
  program.use();
  // A hair's breadth of room at both ends, lest rounding push a vertex over a clipping plane.
  const double reach = batch.reach / mesh_.coverage;
  const double scale = 1.99 / (reach - batch.lowest);
  glUniform1i(program.uniform("frustum"), metric_ == Metric::kFrustum);
  glUniform1f(program.uniform("reach"), static_cast<float>(reach));
  glUniform2f(program.uniform("depth_scale"), static_cast<float>(scale), static_cast<float>(0.995 - scale * reach));
  glUniform1f(program.uniform("viewport"), static_cast<float>(viewport_));

  glBindVertexArray(site_array_.id());
  for (const ZoneRun& run : batch.runs) {
    const std::size_t start = run.first * sizeof(SiteRecord);
    glVertexAttribPointer(3, 4, GL_FLOAT, GL_FALSE, sizeof(SiteRecord), offset(start + offsetof(SiteRecord, x)));
    glVertexAttribPointer(4, 2, GL_FLOAT, GL_FALSE, sizeof(SiteRecord),
                          offset(start + offsetof(SiteRecord, extent_u)));
    glStencilFunc(GL_EQUAL, run.zone, 0xff);
    glUniform1ui(program.uniform("first_slot"), static_cast<GLuint>(run.first));
    glDrawElementsInstanced(GL_TRIANGLES, static_cast<GLsizei>(mesh_.triangles.size()), GL_UNSIGNED_SHORT, nullptr,
                            run.count);
  }
}

void GlRasterizer::settle() const {
  glBindFramebuffer(GL_FRAMEBUFFER, targets_->labels_frame.id());
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_STENCIL_TEST);
  const gl::Program& program = programs_.settle;
  program.use();
  use_texture(program, "slots", 0, targets_->slots);
  use_texture(program, "zones", 1, targets_->zones);
  use_texture(program, "sites", 2, sites_);
  glUniform1i(program.uniform("frustum"), metric_ == Metric::kFrustum);
  glUniform1f(program.uniform("reach"), static_cast<float>(std::min(reach_, kFarthest)));
  draw_screen();
}

// The four bytes of a pixel are its label; where there is none, those of kUnlabelled. The bottom row of GL is the
// canvas' top row, so rows come in order.
void GlRasterizer::read(const Tile& tile, LabelMap& labels) const {
  static_assert(static_cast<std::uint32_t>(kUnlabelled) == kNoSlot);
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glPixelStorei(GL_PACK_ROW_LENGTH, static_cast<GLint>(labels.step1()));
  glReadPixels(tile.core.x - tile.area.x, tile.core.y - tile.area.y, tile.core.width, tile.core.height, GL_RGBA,
               GL_UNSIGNED_BYTE, &labels(tile.core.y, tile.core.x));
}

void GlRasterizer::draw_screen() const {
  glBindVertexArray(screen_array_.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

// The largest tile that every kind of target can have; a power of two, as viewports are.
int driver_limit() {
  GLint texture = 0, renderbuffer = 0, viewport[2] = {0, 0};
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &texture);
  glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &renderbuffer);
  glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport);
  return static_cast<int>(
      std::bit_floor(static_cast<unsigned>(std::min({texture, renderbuffer, viewport[0], viewport[1]}))));
}

}  // namespace

Result<std::unique_ptr<Rasterizer>> make_gl_rasterizer(const GlRasterizerOptions& options) {
  assert(options.tile_limit >= 3);
  if (glGetString(GL_VERSION) == nullptr) return fail(StatusCode::kInternal, "", "OpenGL: no context is current");
  GLint major = 0;
  glGetIntegerv(GL_MAJOR_VERSION, &major);
  if (major < 3) return fail(StatusCode::kInternal, "", "OpenGL: the context is too old; expected OpenGL ES 3.0");
  Result<Programs> programs = Programs::build();
  if (!programs) return tl::unexpected(programs.error());
  return std::make_unique<GlRasterizer>(std::move(*programs), std::min(options.tile_limit, driver_limit()));
}

}  // namespace tessera
