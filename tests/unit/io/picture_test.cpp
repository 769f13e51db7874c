#include "tessera/io/picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tiffio.h>
#include <turbojpeg.h>
#include <webp/encode.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>

#include "picture_files.h"
#include "tessera/io/decoders.h"

namespace tessera {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr std::uint64_t kPlenty = 1'000'000;

// The decoded pixels; fails the test where there are none.
Pixels decoded(const FileBytes& file) {
  const auto picture = decode_picture(file, kPlenty);
  EXPECT_TRUE(picture.has_value()) << picture.error().message;
  if (!picture) return {};
  const std::uint8_t* rgb = picture->rgb.get();
  return {picture->width, picture->height, {rgb, rgb + 3 * picture->width * picture->height}};
}

// What is said of a file that cannot be used.
std::string refusal(const FileBytes& file, std::uint64_t max_pixels = kPlenty) {
  const auto picture = decode_picture(file, max_pixels);
  EXPECT_FALSE(picture.has_value());
  if (picture) return "";
  EXPECT_EQ(picture.error().code, StatusCode::kInvalidInput);
  EXPECT_EQ(picture.error().message.find('\n'), std::string::npos);
  return picture.error().message;
}

void expect_same(const Pixels& a, const Pixels& b, int tolerance = 0) {
  ASSERT_EQ(a.width, b.width);
  ASSERT_EQ(a.height, b.height);
  ASSERT_EQ(a.rgb.size(), b.rgb.size());
  for (std::size_t i = 0; i < a.rgb.size(); ++i) ASSERT_NEAR(a.rgb[i], b.rgb[i], tolerance) << "byte " << i;
}

// A smooth picture, which lossy formats keep within a few levels.
Pixels smooth(int width, int height) {
  Pixels pixels{width, height, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (const int level : {40 + 2 * x, 60 + 2 * y, 120}) pixels.rgb.push_back(static_cast<std::uint8_t>(level));
    }
  }
  return pixels;
}

FileBytes jpeg_file(const Pixels& pixels, int flags = 0) {
  const tjhandle handle = tjInitCompress();
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  tjCompress2(handle, pixels.rgb.data(), pixels.width, 0, pixels.height, TJPF_RGB, &bytes, &size, TJSAMP_444, 100,
              flags);
  FileBytes file(bytes, bytes + size);
  tjFree(bytes);
  tjDestroy(handle);
  return file;
}

FileBytes with_exif(const FileBytes& jpeg, int orientation, bool big_endian) {
  const FileBytes block = exif_block(orientation, big_endian);
  FileBytes segment = {0xFF, 0xE1, 0, static_cast<std::uint8_t>(block.size() + 8), 'E', 'x', 'i', 'f', 0, 0};
  segment.insert(segment.end(), block.begin(), block.end());
  FileBytes file = jpeg;
  file.insert(file.begin() + 2, segment.begin(), segment.end());
  return file;
}

FileBytes webp_file(const FileBytes& rgba, int width, int height) {
  std::uint8_t* bytes = nullptr;
  const std::size_t size = WebPEncodeLosslessRGBA(rgba.data(), width, height, 4 * width, &bytes);
  FileBytes file(bytes, bytes + size);
  WebPFree(bytes);
  return file;
}

// A TIFF through a file, since libtiff seeks in what it writes.
FileBytes tiff_file(int width, int height, const std::function<void(TIFF*)>& describe, const FileBytes& rows) {
  const auto path = std::filesystem::temp_directory_path() / ("tessera-test-" + std::to_string(getpid()) + ".tif");
  TIFF* tiff = TIFFOpen(path.c_str(), "w");
  TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, width);
  TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, height);
  TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
  TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, 2);
  describe(tiff);
  const std::size_t stride = rows.size() / static_cast<std::size_t>(height);
  for (int y = 0; y < height; ++y) {
    FileBytes row(rows.begin() + static_cast<std::ptrdiff_t>(stride) * y,
                  rows.begin() + static_cast<std::ptrdiff_t>(stride) * (y + 1));
    TIFFWriteScanline(tiff, row.data(), static_cast<std::uint32_t>(y), 0);
  }
  TIFFClose(tiff);
  std::ifstream stream(path, std::ios::binary);
  FileBytes file{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  std::filesystem::remove(path);
  return file;
}

void describe_samples(TIFF* tiff, int samples, int bits, int photometric) {
  TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, samples);
  TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, bits);
  TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, photometric);
}

// 24 bits a pixel, rows from the bottom, or from the top where `height` is negative.
FileBytes bmp_file(const Pixels& pixels, bool from_top) {
  const auto stride = static_cast<std::size_t>(pixels.width * 3 + 3) / 4 * 4;
  FileBytes file(54 + stride * static_cast<std::size_t>(pixels.height));
  const auto put = [&](std::size_t at, std::int32_t value) {
    for (std::size_t i = 0; i < 4; ++i) file[at + i] = static_cast<std::uint8_t>(value >> (8 * i));
  };
  file[0] = 'B', file[1] = 'M', file[26] = 1, file[28] = 24;
  put(2, static_cast<std::int32_t>(file.size()));
  put(10, 54), put(14, 40), put(18, pixels.width), put(22, from_top ? -pixels.height : pixels.height);
  for (int y = 0; y < pixels.height; ++y) {
    const int row = from_top ? y : pixels.height - 1 - y;
    std::uint8_t* to = &file[54 + stride * static_cast<std::size_t>(row)];
    const std::uint8_t* from = &pixels.rgb[static_cast<std::size_t>(3 * pixels.width * y)];
    for (int x = 0; x < pixels.width; ++x, from += 3, to += 3) to[0] = from[2], to[1] = from[1], to[2] = from[0];
  }
  return file;
}

// Where the upright picture's pixel (x, y) lies in the stored one, said once more and in another way than the decoder
// does: EXIF names the sides of the upright picture at which row 0 and column 0 are stored.
Pixels stored_as(const Pixels& upright, int orientation) {
  const bool on_its_side = orientation >= 5;
  Pixels stored{on_its_side ? upright.height : upright.width, on_its_side ? upright.width : upright.height, {}};
  stored.rgb.resize(upright.rgb.size());
  const bool row0_at_bottom = orientation == 3 || orientation == 4,
             column0_at_right = orientation == 2 || orientation == 3;
  const bool row0_at_right = orientation == 6 || orientation == 7,
             column0_at_bottom = orientation == 7 || orientation == 8;
  for (int row = 0; row < stored.height; ++row) {
    for (int column = 0; column < stored.width; ++column) {
      int x = column0_at_right ? upright.width - 1 - column : column;
      int y = row0_at_bottom ? upright.height - 1 - row : row;
      if (on_its_side) {
        x = row0_at_right ? upright.width - 1 - row : row;
        y = column0_at_bottom ? upright.height - 1 - column : column;
      }
      for (int c = 0; c < 3; ++c) {
        stored.rgb[static_cast<std::size_t>(3 * (row * stored.width + column) + c)] =
            upright.rgb[static_cast<std::size_t>(3 * (y * upright.width + x) + c)];
      }
    }
  }
  return stored;
}

TEST(PictureTest, ReadsPngColours) { expect_same(decoded(png_file(colourful(7, 5))), colourful(7, 5)); }

TEST(PictureTest, ReadsPngBits) {
  const FileBytes file = png_file(10, 2, 1, PngColour::kGrey, {0b10110000, 0b01000000, 0b00000001, 0b10000000});
  const std::vector<int> bits = {1, 0, 1, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 1, 1, 0};
  Pixels expected{10, 2, {}};
  for (const int bit : bits) expected.rgb.insert(expected.rgb.end(), 3, static_cast<std::uint8_t>(255 * bit));
  expect_same(decoded(file), expected);
}

TEST(PictureTest, ReadsPngPaletteWithTransparency) {
  const std::vector<PngChunk> chunks = {{"PLTE", {10, 20, 30, 200, 100, 0, 1, 2, 3}}, {"tRNS", {255, 0}}};
  const FileBytes file = png_file(4, 1, 2, PngColour::kPalette, {0b00011000}, chunks);
  expect_same(decoded(file), {4, 1, {10, 20, 30, 255, 255, 255, 1, 2, 3, 10, 20, 30}});
}

TEST(PictureTest, LaysAlphaOverWhite) {
  const FileBytes file = png_file(3, 1, 8, PngColour::kRgba, {100, 0, 255, 255, 100, 0, 255, 0, 100, 0, 255, 128});
  expect_same(decoded(file), {3, 1, {100, 0, 255, 255, 255, 255, 177, 127, 255}}, 1);
}

TEST(PictureTest, RoundsSixteenBits) {
  const FileBytes file = png_file(3, 1, 16, PngColour::kGrey, {0, 0, 0x80, 0x00, 0xFF, 0xFF});
  expect_same(decoded(file), {3, 1, {0, 0, 0, 128, 128, 128, 255, 255, 255}});
}

TEST(PictureTest, ReadsGreyWithAlpha) {
  const FileBytes file = png_file(2, 1, 8, PngColour::kGreyAlpha, {40, 255, 40, 0});
  expect_same(decoded(file), {2, 1, {40, 40, 40, 255, 255, 255}});
}

TEST(PictureTest, ReadsJpegAndProgressiveJpeg) {
  expect_same(decoded(jpeg_file(smooth(40, 24))), smooth(40, 24), 3);
  expect_same(decoded(jpeg_file(smooth(40, 24), TJFLAG_PROGRESSIVE)), smooth(40, 24), 3);
}

TEST(PictureTest, ReadsWebp) {
  const FileBytes rgba = {10, 20, 30, 255, 0, 0, 0, 0, 250, 0, 9, 255, 100, 100, 100, 128};
  const Pixels expected{2, 2, {10, 20, 30, 255, 255, 255, 250, 0, 9, 177, 177, 177}};
  expect_same(decoded(webp_file(rgba, 2, 2)), expected, 1);
}

TEST(PictureTest, ReadsTiff) {
  const Pixels pixels = colourful(6, 5);
  const auto rgb = [](TIFF* tiff) { describe_samples(tiff, 3, 8, PHOTOMETRIC_RGB); };
  expect_same(decoded(tiff_file(6, 5, rgb, pixels.rgb)), pixels);
  const auto grey16 = [](TIFF* tiff) { describe_samples(tiff, 1, 16, PHOTOMETRIC_MINISBLACK); };
  const FileBytes rows = {0, 0, 0xFF, 0xFF, 0, 0x80, 0, 0x40};  // little-endian
  expect_same(decoded(tiff_file(2, 2, grey16, rows)), {2, 2, {0, 0, 0, 255, 255, 255, 128, 128, 128, 64, 64, 64}}, 1);
}

TEST(PictureTest, ReadsBmpFromBothEnds) {
  expect_same(decoded(bmp_file(colourful(5, 4), false)), colourful(5, 4));
  expect_same(decoded(bmp_file(colourful(5, 4), true)), colourful(5, 4));
}

TEST(PictureTest, TurnsPicturesUpright) {
  const Pixels upright = colourful(6, 4);
  for (int orientation = 1; orientation <= 8; ++orientation) {
    SCOPED_TRACE(orientation);
    const Pixels stored = stored_as(upright, orientation);
    expect_same(decoded(png_file(stored, {{"eXIf", exif_block(orientation, orientation % 2 == 0)}})), upright);
    const auto describe = [&](TIFF* tiff) {
      describe_samples(tiff, 3, 8, PHOTOMETRIC_RGB);
      TIFFSetField(tiff, TIFFTAG_ORIENTATION, orientation);
    };
    expect_same(decoded(tiff_file(stored.width, stored.height, describe, stored.rgb)), upright);
    const Pixels wide = smooth(40, 24);
    expect_same(decoded(with_exif(jpeg_file(stored_as(wide, orientation)), orientation, orientation % 2 == 1)), wide,
                3);
  }
}

TEST(PictureTest, IgnoresSenselessOrientations) {
  for (const int orientation : {0, 9, 255}) {
    const FileBytes file = png_file(colourful(3, 2), {{"eXIf", exif_block(orientation, false)}});
    expect_same(decoded(file), colourful(3, 2));
  }
}

double dpi_of(const FileBytes& file) {
  const auto picture = decode_picture(file, kPlenty);
  EXPECT_TRUE(picture.has_value());
  return picture ? picture->dpi : -1;
}

TEST(PictureTest, TellsItsResolution) {
  const auto png = [](std::uint32_t x, std::uint32_t y, std::uint8_t unit) {
    FileBytes data;
    append_big_endian(data, x);
    append_big_endian(data, y);
    data.push_back(unit);
    return png_file(colourful(3, 2), {{"pHYs", data}});
  };
  EXPECT_EQ(dpi_of(png(11811, 11811, 1)), 300);
  EXPECT_NEAR(dpi_of(png(11800, 11800, 1)), 299.72, 0.001);
  EXPECT_EQ(dpi_of(png(11811, 5906, 1)), 0);  // pixels that are no squares
  EXPECT_EQ(dpi_of(png(1, 1, 0)), 0);
  EXPECT_EQ(dpi_of(png_file(colourful(3, 2))), 0);

  // JFIF's header is the first segment: its unit is at 13, the densities follow.
  const auto jpeg = [](std::uint8_t unit, int x, int y) {
    FileBytes file = jpeg_file(smooth(16, 8));
    file[13] = unit;
    file[14] = static_cast<std::uint8_t>(x >> 8), file[15] = static_cast<std::uint8_t>(x);
    file[16] = static_cast<std::uint8_t>(y >> 8), file[17] = static_cast<std::uint8_t>(y);
    return file;
  };
  EXPECT_EQ(dpi_of(jpeg(1, 600, 600)), 600);
  EXPECT_NEAR(dpi_of(jpeg(2, 118, 118)), 299.72, 0.01);
  EXPECT_EQ(dpi_of(jpeg(0, 1, 1)), 0);
  EXPECT_EQ(dpi_of(jpeg(1, 0, 0)), 0);

  const auto tiff = [](int unit, float x) {
    return tiff_file(
        2, 2,
        [=](TIFF* file) {
          describe_samples(file, 3, 8, PHOTOMETRIC_RGB);
          TIFFSetField(file, TIFFTAG_RESOLUTIONUNIT, unit);
          TIFFSetField(file, TIFFTAG_XRESOLUTION, x);
          TIFFSetField(file, TIFFTAG_YRESOLUTION, x);
        },
        FileBytes(12));
  };
  EXPECT_EQ(dpi_of(tiff(RESUNIT_INCH, 400)), 400);
  EXPECT_EQ(dpi_of(tiff(RESUNIT_CENTIMETER, 200)), 508);
  EXPECT_EQ(dpi_of(tiff(RESUNIT_NONE, 200)), 0);
}

TEST(PictureTest, KeepsAlphaWhereThereIsSome) {
  const auto clear =
      decode_picture(png_file(3, 1, 8, PngColour::kRgba, {9, 9, 9, 255, 9, 9, 9, 0, 9, 9, 9, 128}), kPlenty);
  ASSERT_TRUE(clear->alpha);
  EXPECT_EQ(std::vector<int>(clear->alpha.get(), clear->alpha.get() + 3), (std::vector<int>{255, 0, 128}));
  EXPECT_FALSE(decode_picture(png_file(1, 1, 8, PngColour::kRgba, {9, 9, 9, 255}), kPlenty)->alpha);
  EXPECT_FALSE(decode_picture(png_file(colourful(3, 2)), kPlenty)->alpha);
}

TEST(PictureTest, RefusesOtherKinds) {
  const std::string expected = "expected PNG, JPEG, WebP, TIFF or BMP";
  for (const std::string text : {"GIF89a and more", "<svg xmlns='x'/>", "B", "\x89PNG", "hello"}) {
    EXPECT_THAT(refusal({text.begin(), text.end()}), HasSubstr(expected)) << text;
  }
  EXPECT_THAT(refusal({}), AllOf(StartsWith("is empty"), HasSubstr(expected)));
}

TEST(PictureTest, RefusesTooManyAndNoPixels) {
  EXPECT_THAT(refusal(png_file(100000, 100000, 1, PngColour::kGrey, {})),
              AllOf(HasSubstr("100000 x 100000"), HasSubstr("--max-pixels")));
  EXPECT_THAT(refusal(png_file(0, 0, 1, PngColour::kGrey, {})), HasSubstr("0 x 0"));
  EXPECT_THAT(refusal(png_file(colourful(7, 5)), 34), HasSubstr("--max-pixels"));
  EXPECT_TRUE(decode_picture(png_file(colourful(7, 5)), 35).has_value());
  EXPECT_THAT(refusal(jpeg_file(smooth(40, 24)), 959), HasSubstr("--max-pixels"));
  EXPECT_THAT(refusal(bmp_file(colourful(5, 4), true), 19), HasSubstr("--max-pixels"));
  EXPECT_THAT(refusal(webp_file(FileBytes(64, 200), 4, 4), 15), HasSubstr("--max-pixels"));
  // More than the limit allows would be more than OpenCV can address.
  EXPECT_THAT(refusal(png_file(2000000, 1, 1, PngColour::kGrey, {}), kPlenty * 1000), HasSubstr("sides of at most"));
}

// Every kind, cut at every length: a refusal and no crash, whatever is missing.
TEST(PictureTest, RefusesFilesCutShort) {
  const auto rgb = [](TIFF* tiff) { describe_samples(tiff, 3, 8, PHOTOMETRIC_RGB); };
  const FileBytes files[] = {png_file(colourful(16, 12)),
                             jpeg_file(smooth(40, 24)),
                             jpeg_file(smooth(40, 24), TJFLAG_PROGRESSIVE),
                             webp_file(FileBytes(256, 77), 8, 8),
                             bmp_file(colourful(8, 8), false),
                             tiff_file(6, 5, rgb, colourful(6, 5).rgb)};
  for (const FileBytes& file : files) {
    ASSERT_TRUE(decode_picture(file, kPlenty).has_value());
    for (std::size_t size = 0; size < file.size(); ++size) {
      EXPECT_FALSE(decode_picture({file.data(), size}, kPlenty).has_value()) << size << " of " << file.size();
    }
  }
}

TEST(PictureTest, RefusesDamagedPng) {
  FileBytes file = png_file(colourful(16, 12));
  file[60] ^= 0x10;  // within IDAT
  EXPECT_THAT(refusal(file), HasSubstr("damaged PNG"));
}

TEST(PictureTest, RefusesCompressedBmp) {
  FileBytes file = bmp_file(colourful(5, 4), false);
  file[30] = 1;
  EXPECT_THAT(refusal(file), HasSubstr("compressed BMP"));
}

// Any byte may be wrong: an answer comes in any case.
TEST(PictureTest, SurvivesAnyWrongByte) {
  const auto rgb = [](TIFF* tiff) { describe_samples(tiff, 3, 8, PHOTOMETRIC_RGB); };
  const FileBytes files[] = {png_file(colourful(6, 4), {{"eXIf", exif_block(6, true)}}),
                             with_exif(jpeg_file(smooth(16, 8)), 8, false), webp_file(FileBytes(64, 77), 4, 4),
                             bmp_file(colourful(5, 4), false), tiff_file(6, 5, rgb, colourful(6, 5).rgb)};
  for (const FileBytes& file : files) {
    for (std::size_t i = 0; i < file.size(); ++i) {
      for (const int flip : {0x01, 0x80, 0xFF}) {
        FileBytes wrong = file;
        wrong[i] = static_cast<std::uint8_t>(wrong[i] ^ flip);
        const auto picture = decode_picture(wrong, kPlenty);
        if (picture) {
          EXPECT_GT(picture->width, 0);
          EXPECT_LE(std::uint64_t(picture->width) * std::uint64_t(picture->height), kPlenty);
        }
      }
    }
  }
}

// libtiff repeats what a damaged file says.
TEST(Damaged, ReasonsAreALineOfAscii) {
  EXPECT_EQ(damaged("TIFF", "tag \n\x01\xff?").value().message, "is a damaged TIFF (tag    ?), expected a whole one");
}

}  // namespace
}  // namespace tessera
