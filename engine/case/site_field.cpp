// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/case/site_field.hpp"

#include "io/json.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace asperity {

FieldFile heights_of(const Case& c) {
    const Scene::Surface& s = c.scene.surface;
    return {s.file,
            c.file,
            {s.file_unit, s.file_missing == MapMissing::fill, s.file_crop == MapCrop::middle,
             s.file_size, s.file_missing == MapMissing::hole}};
}

FieldFile counter_heights_of(const Case& c) {
    const Scene::Surface::Counter& s = c.scene.surface.counter;
    return {s.file,
            c.counter_file,
            {s.unit,
             s.missing == MapMissing::fill,
             s.crop == MapCrop::middle,
             s.size,
             false,
             {.key = "surface.counter"}}};
}

io::HeightMap read_field(const FieldFile& field, const Communicator& ranks) {
    io::HeightMap map;
    std::string head;
    ranks.on_root([&] {
        map = io::read_height_map(field.file, field.how);
        if (ranks.size() == 1) return;
        io::Json json = {{"rows", map.rows}, {"unit", map.unit}, {"origin", map.origin}};
        json["notes"] = map.notes;
        json["doubts"] = map.doubts;
        if (map.width) json["width"] = *map.width;
        head = io::json_text(json);
    });
    if (ranks.size() == 1) return map;
    std::array<std::uint64_t, 2> sizes = {head.size(), map.heights.size()};
    ranks.broadcast(std::as_writable_bytes(std::span(sizes)));
    head.resize(sizes[0]);
    map.heights.resize(sizes[1]);
    ranks.broadcast(std::as_writable_bytes(std::span(head)));
    ranks.broadcast(std::span(map.heights));
    const io::Json json = io::parse_json(head, field.name);
    map.rows = map.columns = json["rows"];
    map.unit = json["unit"];
    map.origin = json["origin"];
    map.notes = json["notes"].get<std::vector<std::string>>();
    map.doubts = json["doubts"].get<std::vector<std::string>>();
    if (json.contains("width")) map.width = json["width"].get<double>();
    return map;
}

} // namespace asperity
