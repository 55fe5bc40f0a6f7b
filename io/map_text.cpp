// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
//
// Height maps as text. Comments of the form "# name: value" or "# name = value" are looked at for
// size and unit; the names are those that Gwyddion and SPIP write.
#include "io/map_formats.hpp"
#include "io/units.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>

namespace asperity::io {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::optional<double> number(std::string_view text) {
    if (text.starts_with('+')) text.remove_prefix(1);
    double value = 0.0;
    const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
    if (parsed.ec == std::errc::result_out_of_range) return nan; // a missing point, at its place
    if (parsed.ec != std::errc() || parsed.ptr != text.data() + text.size()) return std::nullopt;
    return value;
}

struct Line {
    std::string_view text; ///< without its comment
    std::size_t number = 0;
};

/// The lines with data, and what the comments between them say.
struct Text {
    std::string file;
    std::vector<Line> lines;
    std::map<std::string, std::string> header; ///< names in lower case
    std::string separators = "\t\r ;,";
    bool decimal_comma = false;

    std::string where(std::size_t line, std::size_t column = 1) const {
        return fmt::format("{}:{}:{}", file, line, column);
    }
};

Text split(std::string_view text, const std::string& file) {
    Text result;
    result.file = file;
    for (std::size_t line = 1, at = 0; at < text.size(); ++line) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        std::string_view whole = text.substr(at, end - at);
        at = end + 1;
        if (const std::size_t nul = whole.find('\0'); nul != std::string_view::npos)
            refuse(result.where(line, nul + 1), "the height map is no text", "it holds a zero byte",
                   "name a text file, or give it its own ending");
        const std::size_t hash = whole.find('#');
        if (hash != std::string_view::npos) {
            std::string_view comment = whole.substr(hash + 1);
            const std::size_t colon = comment.find_first_of(":=");
            if (colon != std::string_view::npos)
                result.header.try_emplace(lower(trimmed(comment.substr(0, colon))),
                                          trimmed(comment.substr(colon + 1)));
            whole = whole.substr(0, hash);
        }
        if (!trimmed(whole).empty()) result.lines.push_back({whole, line});
    }
    return result;
}

/// Are commas decimal points? Looks at all of them; refuses where both readings make sense.
void judge_commas(Text& text) {
    bool other = false, blank = false, point = false; // separators seen, and decimal points
    const Line* comma = nullptr;                      // the first line with a comma
    for (const Line& line : text.lines) {
        std::string_view rest = trimmed(line.text);
        point = point || rest.find('.') != std::string_view::npos;
        while (!rest.empty()) {
            const std::size_t end = std::min(rest.find_first_of(" \t\r;"), rest.size());
            const std::string_view token = rest.substr(0, end);
            const std::size_t at = token.find(',');
            if (at != std::string_view::npos) {
                if (!comma) comma = &line;
                const auto digit = [&](std::size_t i) {
                    return i < token.size() && token[i] >= '0' && token[i] <= '9';
                };
                // "1,2,3", "1," and ",1" are lists
                if (at == 0 || !digit(at - 1) || !digit(at + 1) ||
                    token.find(',', at + 1) != std::string_view::npos)
                    return;
            }
            if (end < rest.size()) {
                const std::size_t next =
                    std::min(rest.find_first_not_of(" \t\r;", end), rest.size());
                const std::string_view gap = rest.substr(end, next - end);
                if (gap.find_first_of("\t;") != std::string_view::npos)
                    other = true;
                else
                    blank = true;
                rest.remove_prefix(next);
            } else {
                rest = {};
            }
        }
    }
    if (!comma || (!other && !blank)) return; // one comma a line: two columns
    if (!other || point)
        refuse(text.where(comma->number), "the commas may be decimal points or separate numbers",
               "there are blanks between numbers as well, and commas inside",
               "write decimal points, or separate the numbers by tabs or semicolons");
    text.decimal_comma = true;
    text.separators = "\t\r ;";
}

/// Calls take(value, where, word) for each number of a line. A word that is no number is refused.
template <class Take>
void numbers(const Text& text, const Line& line, const Take& take) {
    std::string changed;
    for (std::size_t at = 0;
         (at = line.text.find_first_not_of(text.separators, at)) != std::string_view::npos;) {
        const std::size_t end =
            std::min(line.text.find_first_of(text.separators, at), line.text.size());
        const std::string_view word = line.text.substr(at, end - at);
        std::string_view plain = word;
        if (text.decimal_comma) {
            changed = word;
            std::replace(changed.begin(), changed.end(), ',', '.');
            plain = changed;
        }
        std::optional<double> value = number(plain);
        if (!value && (lower(word) == "bad" || lower(word) == "void")) value = nan;
        if (!value)
            refuse(text.where(line.number, at + 1),
                   fmt::format("'{}' is no height", word.substr(0, 40)),
                   "a map is a matrix of numbers, one row a line",
                   "take headings out of the file, or put a # before them");
        take(*value, at + 1, word);
        at = end;
    }
}

void note_missing(const Text& text, RawMap& map, double& value, const Line& line,
                  std::size_t column, std::string_view word) {
    if (std::isfinite(value)) return;
    value = nan;
    if (map.missing++ > 0) return;
    map.first_missing = text.where(line.number, column);
    map.first_missing_text = word.substr(0, 40);
}

/// A size as the header gives it, Å: with a unit, or in that of `otherwise`. Comments that only
/// look like a size ("# Width: see the paper") are passed over.
std::optional<double> size_in(const Text& text, RawMap& map, const std::string& key,
                              const std::optional<std::string>& otherwise) {
    const auto entry = text.header.find(key);
    if (entry == text.header.end()) return std::nullopt;
    std::string written = entry->second;
    const std::size_t end = written.find_first_not_of("+-0123456789.,eE");
    std::string digits = written.substr(0, end);
    std::replace(digits.begin(), digits.end(), ',', '.');
    const std::optional<double> value = number(digits);
    if (!value) return std::nullopt;
    std::string unit(
        trimmed(end == std::string::npos ? "" : std::string_view(written).substr(end)));
    if (unit.empty() && otherwise) unit = *otherwise;
    if (unit.empty())
        refuse(text.file, fmt::format("the header '{}: {}' has no unit", key, written),
               "a length without a unit may be anything",
               "write the unit behind it, or take the line out and set surface.file_size");
    if (!std::isfinite(*value) || !(*value > 0.0))
        refuse(text.file, fmt::format("the header '{}: {}' is no size", key, written),
               "it is not above zero", "correct the header");
    map.size_in_unit = false;
    return *value * length_unit(unit, text.file);
}

void check_points(const Text& text, const std::string& key, std::size_t there) {
    const auto entry = text.header.find(key);
    if (entry == text.header.end()) return;
    const std::optional<double> told = number(entry->second);
    if (told && *told != static_cast<double>(there))
        refuse(text.file, "the height map is not whole",
               fmt::format("its header says {} = {}, and {} are there", key, entry->second, there),
               "export it again");
}

void read_header(const Text& text, RawMap& map) {
    const auto value = [&](const char* key) -> std::optional<std::string> {
        const auto entry = text.header.find(key);
        if (entry == text.header.end() || entry->second.empty()) return std::nullopt;
        return entry->second;
    };
    const bool spip =
        value("x-pixels") || value("bit2nm") || lower(value("file format").value_or("")) == "ascii";
    map.format = spip ? "SPIP text" : value("value units") ? "Gwyddion text" : "text matrix";
    check_points(text, "x-pixels", map.columns);
    check_points(text, "y-pixels", map.rows);
    for (const char* key : {"value units", "z-unit"})
        if (!map.file_unit) map.file_unit = value(key);
    if (const auto scale = value("bit2nm"); scale && !map.file_unit) {
        const std::optional<double> factor = number(*scale);
        if (!factor || !std::isfinite(*factor) || *factor == 0.0)
            refuse(text.file, fmt::format("the header 'Bit2nm = {}' is no factor", *scale), "",
                   "correct the header");
        map.file_unit = "nm";
        map.file_scale = *factor;
    }
    std::optional<std::string> lateral = value("x-unit");
    if (!lateral) lateral = spip ? std::optional<std::string>("nm") : map.file_unit;
    for (const char* key : {"width", "x-length", "edge"})
        if (!map.width) map.width = size_in(text, map, key, lateral);
    for (const char* key : {"height", "y-length", "edge"})
        if (!map.height)
            map.height = size_in(text, map, key, value("y-unit") ? value("y-unit") : lateral);
}

RawMap read_matrix(const Text& text) {
    RawMap map;
    std::size_t first_line = 0;
    for (const Line& line : text.lines) {
        std::size_t columns = 0;
        numbers(text, line, [&](double value, std::size_t column, std::string_view word) {
            note_missing(text, map, value, line, column, word);
            map.heights.push_back(value);
            ++columns;
        });
        if (columns == 0) continue; // separators only
        if (map.rows == 0) map.columns = columns, first_line = line.number;
        if (columns != map.columns)
            refuse(text.where(line.number), "the rows of the map are not of one length",
                   fmt::format("this line has {} numbers, line {} has {}", columns, first_line,
                               map.columns),
                   "give every row as many numbers");
        ++map.rows;
    }
    read_header(text, map);
    return map;
}

/// The places on an axis: sorted, evenly spaced to a hundredth of a pixel.
std::vector<double> axis(const Text& text, std::vector<double> places, char name) {
    std::sort(places.begin(), places.end());
    const double span = places.back() - places.front();
    std::vector<double> distinct;
    for (const double x : places)
        if (distinct.empty() || x - distinct.back() > 1e-6 * span) distinct.push_back(x);
    const double pixel = span / static_cast<double>(std::max<std::size_t>(1, distinct.size() - 1));
    for (std::size_t i = 0; i < distinct.size(); ++i)
        if (std::abs(distinct[i] - (distinct.front() + static_cast<double>(i) * pixel)) >
            0.01 * pixel)
            refuse(text.file, "the points of the map are on no grid",
                   fmt::format("{} = {} is no whole number of pixels of {:.6g} from {}", name,
                               distinct[i], pixel, distinct.front()),
                   "interpolate them onto a grid before");
    if (distinct.size() < 2)
        refuse(text.file, "the height map has one row",
               fmt::format("all its points have {} = {}", name, distinct.front()), "");
    return distinct;
}

RawMap read_xyz(const Text& text) {
    RawMap map;
    map.format = "XYZ";
    std::vector<double> x, y, z;
    std::vector<const Line*> from;
    for (const Line& line : text.lines) {
        std::size_t count = 0;
        numbers(text, line, [&](double value, std::size_t column, std::string_view word) {
            if (count < 2 && !std::isfinite(value))
                refuse(text.where(line.number, column), fmt::format("'{}' is no place", word),
                       "x and y of a point are needed", "take the line out");
            if (count == 2) note_missing(text, map, value, line, column, word);
            (count == 0 ? x : count == 1 ? y : z).push_back(value);
            ++count;
        });
        if (count == 0) continue;
        if (count != 3)
            refuse(text.where(line.number), "the line is no point of a map",
                   fmt::format("it has {} numbers, and x, y and z are needed", count),
                   "a matrix of heights must not be called .xyz");
        from.push_back(&line);
    }
    if (z.empty()) return map;
    const std::vector<double> columns = axis(text, x, 'x'), rows = axis(text, y, 'y');
    map.columns = columns.size();
    map.rows = rows.size();
    if (map.columns * map.rows > 4 * z.size()) // before allocating: a cloud, not a grid
        refuse(text.file, "the points of the map are on no grid",
               fmt::format("{} points have {} different x and {} different y", z.size(),
                           map.columns, map.rows),
               "interpolate them onto a grid before");
    const double dx = (columns.back() - columns.front()) / static_cast<double>(map.columns - 1),
                 dy = (rows.back() - rows.front()) / static_cast<double>(map.rows - 1);
    map.heights.assign(map.columns * map.rows, nan);
    std::vector<bool> seen(map.heights.size());
    for (std::size_t i = 0; i < z.size(); ++i) {
        const auto c = static_cast<std::size_t>(std::lround((x[i] - columns.front()) / dx)),
                   r = static_cast<std::size_t>(std::lround((y[i] - rows.front()) / dy));
        if (seen[r * map.columns + c])
            refuse(text.where(from[i]->number), "the point is in the map already",
                   fmt::format("x = {}, y = {} stands twice", x[i], y[i]), "take one out");
        seen[r * map.columns + c] = true;
        map.heights[r * map.columns + c] = z[i];
    }
    if (const auto gap = std::find(seen.begin(), seen.end(), false); gap != seen.end()) {
        const auto at = static_cast<std::size_t>(gap - seen.begin());
        if (map.missing == 0) {
            map.first_missing = text.file;
            map.first_missing_text = fmt::format("not given (x = {}, y = {})",
                                                 columns[at % map.columns], rows[at / map.columns]);
        }
        map.missing += static_cast<std::size_t>(std::count(seen.begin(), seen.end(), false));
    }
    map.width = dx * static_cast<double>(map.columns);
    map.height = dy * static_cast<double>(map.rows);
    map.size_in_unit = true;
    return map;
}

RawMap read_esri(const Text& text) {
    std::map<std::string, double> header;
    std::size_t first = 0;
    for (; first < text.lines.size(); ++first) { // "name value", until a line begins with a number
        const std::string_view line = trimmed(text.lines[first].text);
        if (std::string_view("+-.0123456789").find(line[0]) != std::string_view::npos) break;
        const std::size_t blank = std::min(line.find_first_of(blanks), line.size());
        const std::optional<double> value = number(trimmed(line.substr(blank)));
        if (!value || !std::isfinite(*value) || header.size() > 16)
            refuse(text.where(text.lines[first].number), "the line is no header of a grid",
                   "a name and a number are needed", "export the grid again");
        header[lower(line.substr(0, blank))] = *value;
    }
    Text data = text;
    data.lines.erase(data.lines.begin(), data.lines.begin() + static_cast<std::ptrdiff_t>(first));
    data.header.clear();
    RawMap map = read_matrix(data);
    map.format = "ESRI grid";
    for (const auto& [key, there] : {std::pair("ncols", map.columns), std::pair("nrows", map.rows)})
        if (header.contains(key) && header[key] != static_cast<double>(there))
            refuse(
                text.file, "the height map is not whole",
                fmt::format("its header says {} = {}, and {} are there", key, header[key], there),
                "export the grid again");
    if (header.contains("nodata_value"))
        for (std::size_t i = 0; i < map.heights.size(); ++i)
            if (map.heights[i] == header["nodata_value"]) {
                map.heights[i] = nan;
                if (map.missing++ > 0) continue;
                map.first_missing =
                    fmt::format("{}[{}, {}]", text.file, i / map.columns, i % map.columns);
                map.first_missing_text = fmt::format("nodata ({})", header["nodata_value"]);
            }
    const auto pixel = [&](const char* own) {
        const double size = header.contains(own) ? header[own] : header["cellsize"];
        if (!(size > 0.0))
            refuse(text.file, "the grid has no pixel size", "cellsize is not above zero",
                   "export the grid again");
        return size;
    };
    map.width = pixel("dx") * static_cast<double>(map.columns);
    map.height = pixel("dy") * static_cast<double>(map.rows);
    map.size_in_unit = true;
    return map;
}

} // namespace

RawMap read_map_text(std::string_view bytes, const std::string& file, bool xyz) {
    if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);
    Text text = split(bytes, file);
    const bool esri =
        !text.lines.empty() && lower(trimmed(text.lines.front().text)).starts_with("ncols");
    if (!esri) judge_commas(text);
    return esri ? read_esri(text) : xyz ? read_xyz(text) : read_matrix(text);
}

} // namespace asperity::io
