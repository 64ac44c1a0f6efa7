#include "view/sixel.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace tendril {
namespace {

constexpr int most_colours = 256;
constexpr int bits = 5, levels = 1 << bits;  // of each of red, green and blue

/// One cell of the colours' cube: how many pixels lie in it, and their sum.
struct Cell {
  std::array<long, 3> sum{};
  long count = 0;
};

int cell_of(const std::uint8_t* rgb) { return (rgb[0] >> (8 - bits)) << 2 * bits | (rgb[1] >> (8 - bits)) << bits | rgb[2] >> (8 - bits); }

int coordinate(int cell, int axis) { return cell >> bits * (2 - axis) & (levels - 1); }

/// Cells that share a colour: a part of the list of those in use.
struct Box {
  std::size_t from, to;
  int axis = 0;       ///< along which they spread most
  double spread = 0;  ///< times the number of pixels
};

Box measured(const std::vector<int>& used, const std::vector<Cell>& cells, std::size_t from, std::size_t to) {
  Box box{from, to};
  long count = 0;
  std::array<double, 3> sum{}, squares{};
  for (std::size_t i = from; i < to; ++i) {
    const Cell& cell = cells[used[i]];
    count += cell.count;
    for (int axis = 0; axis < 3; ++axis) {
      const double x = coordinate(used[i], axis);
      sum[axis] += x * double(cell.count);
      squares[axis] += x * x * double(cell.count);
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    const double spread = squares[axis] - sum[axis] * sum[axis] / double(count);  // pixels times their variance
    if (spread > box.spread) box.axis = axis, box.spread = spread;
  }
  return box;
}

/// Where a box is cut: half of its pixels on each side, as nearly as whole levels allow.
std::size_t cut_of(std::vector<int>& used, const std::vector<Cell>& cells, const Box& box) {
  const auto begin = used.begin() + static_cast<std::ptrdiff_t>(box.from), end = used.begin() + static_cast<std::ptrdiff_t>(box.to);
  std::sort(begin, end, [&](int a, int b) {
    const int x = coordinate(a, box.axis), y = coordinate(b, box.axis);
    return x != y ? x < y : a < b;
  });
  const long all = std::accumulate(begin, end, 0L, [&](long sum, int cell) { return sum + cells[cell].count; });
  long below = 0;
  for (std::size_t i = box.from; i + 1 < box.to; ++i) {
    below += cells[used[i]].count;
    if (2 * below >= all) return i + 1;
  }
  return box.to - 1;
}

std::vector<Box> boxes_of(std::vector<int>& used, const std::vector<Cell>& cells) {
  std::vector<Box> boxes{measured(used, cells, 0, used.size())};
  while (boxes.size() < most_colours) {
    const auto widest = std::max_element(boxes.begin(), boxes.end(), [](const Box& a, const Box& b) { return a.spread < b.spread; });
    if (widest->spread <= 0) break;
    const Box box = *widest;
    const std::size_t cut = cut_of(used, cells, box);
    *widest = measured(used, cells, box.from, cut);
    boxes.push_back(measured(used, cells, cut, box.to));
  }
  return boxes;
}

/// `count` times the same character.
void add_run(std::string& text, char character, int count) {
  if (count > 3) text += "!" + std::to_string(count) + character;
  else text.append(static_cast<std::size_t>(count), character);
}

/// One colour's line of a band: bit k of a character is row k.
void add_line(std::string& text, const std::vector<std::uint8_t>& rows, int first, int last) {
  int run = 0;
  char before = 0;
  add_run(text, '?', first);  // nothing of this colour so far
  for (int x = first; x <= last; ++x) {
    const char now = static_cast<char>('?' + rows[x]);
    if (run && now != before) add_run(text, before, std::exchange(run, 0));
    before = now;
    ++run;
  }
  add_run(text, before, run);
}

void add_band(std::string& text, const RgbImage& image, const Palette& palette, int top) {
  const int height = std::min(6, image.height - top);
  std::array<bool, most_colours> present{};
  for (int y = top; y < top + height; ++y)
    for (int x = 0; x < image.width; ++x) present[palette.of_pixel[static_cast<std::size_t>(y) * image.width + x]] = true;
  std::vector<std::uint8_t> rows(image.width);
  bool first_line = true;
  for (int colour = 0; colour < most_colours; ++colour) {
    if (!present[colour]) continue;
    int first = image.width, last = 0;
    for (int x = 0; x < image.width; ++x) {
      rows[x] = 0;
      for (int k = 0; k < height; ++k)
        if (palette.of_pixel[static_cast<std::size_t>(top + k) * image.width + x] == colour) rows[x] |= static_cast<std::uint8_t>(1 << k);
      if (rows[x]) first = std::min(first, x), last = x;
    }
    if (!first_line) text += '$';  // back to the left edge
    first_line = false;
    text += "#" + std::to_string(colour);
    add_line(text, rows, first, last);
  }
}

}  // namespace

RgbImage shrunk(const RgbImage& image, int width, int height) {
  RgbImage small{width, height, std::vector<std::uint8_t>(static_cast<std::size_t>(width) * height * 3)};
  for (int y = 0; y < height; ++y) {
    const int y0 = static_cast<int>(long(y) * image.height / height), y1 = std::max(y0 + 1, static_cast<int>(long(y + 1) * image.height / height));
    for (int x = 0; x < width; ++x) {
      const int x0 = static_cast<int>(long(x) * image.width / width), x1 = std::max(x0 + 1, static_cast<int>(long(x + 1) * image.width / width));
      std::array<long, 3> sum{};
      for (int v = y0; v < y1; ++v)
        for (int u = x0; u < x1; ++u)
          for (int k = 0; k < 3; ++k) sum[k] += image.rgb[(static_cast<std::size_t>(v) * image.width + u) * 3 + k];
      const long count = long(y1 - y0) * (x1 - x0);
      for (int k = 0; k < 3; ++k)
        small.rgb[(static_cast<std::size_t>(y) * width + x) * 3 + k] = static_cast<std::uint8_t>((sum[k] + count / 2) / count);
    }
  }
  return small;
}

Palette palette_of(const RgbImage& image) {
  const std::size_t pixels = static_cast<std::size_t>(image.width) * image.height;
  std::vector<Cell> cells(std::size_t(levels) * levels * levels);
  for (std::size_t i = 0; i < pixels; ++i) {
    Cell& cell = cells[cell_of(&image.rgb[3 * i])];
    ++cell.count;
    for (int k = 0; k < 3; ++k) cell.sum[k] += image.rgb[3 * i + k];
  }
  std::vector<int> used;
  for (int cell = 0; cell < static_cast<int>(cells.size()); ++cell)
    if (cells[cell].count) used.push_back(cell);
  Palette palette;
  if (used.empty()) return palette;
  std::vector<std::uint8_t> colour_of_cell(cells.size());
  for (const Box& box : boxes_of(used, cells)) {
    Cell all;
    for (std::size_t i = box.from; i < box.to; ++i) {
      colour_of_cell[used[i]] = static_cast<std::uint8_t>(palette.rgb.size() / 3);
      all.count += cells[used[i]].count;
      for (int k = 0; k < 3; ++k) all.sum[k] += cells[used[i]].sum[k];
    }
    for (int k = 0; k < 3; ++k) palette.rgb.push_back(static_cast<std::uint8_t>((all.sum[k] + all.count / 2) / all.count));
  }
  palette.of_pixel.reserve(pixels);
  for (std::size_t i = 0; i < pixels; ++i) palette.of_pixel.push_back(colour_of_cell[cell_of(&image.rgb[3 * i])]);
  return palette;
}

std::string sixels_of(const RgbImage& image) {
  const Palette palette = palette_of(image);
  std::string text = "\033P0;1;0q\"1;1;" + std::to_string(image.width) + ";" + std::to_string(image.height);
  const auto percent = [](int level) { return std::to_string((level * 100 + 127) / 255); };
  for (std::size_t c = 0; c < palette.rgb.size() / 3; ++c)
    text += "#" + std::to_string(c) + ";2;" + percent(palette.rgb[3 * c]) + ";" + percent(palette.rgb[3 * c + 1]) + ";" +
            percent(palette.rgb[3 * c + 2]);
  for (int top = 0; top < image.height; top += 6) {
    if (top > 0) text += '-';  // the next band
    add_band(text, image, palette, top);
  }
  return text + "\033\\";
}

}  // namespace tendril
