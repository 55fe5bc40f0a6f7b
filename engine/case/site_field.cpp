// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "engine/case/site_field.hpp"

#include "io/files.hpp"
#include "io/json.hpp"

#include <span>
#include <utility>
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

FieldMap read_field(const FieldFile& field, const Communicator& ranks) {
    FieldMap read;
    io::HeightMap& map = read.map;
    std::string head;
    ranks.on_root([&] {
        map = io::read_height_map(field.file, field.how);
        const double width = map.width.value_or(0.0);
        read.digest =
            io::digest_of(std::as_bytes(std::span(&width, 1)),
                          io::digest_of(std::as_bytes(std::span(std::as_const(map.heights)))));
        if (ranks.size() == 1) return;
        io::Json json = {{"rows", map.rows},
                         {"unit", map.unit},
                         {"origin", map.origin},
                         {"digest", read.digest}};
        json["notes"] = map.notes;
        json["doubts"] = map.doubts;
        if (map.width) json["width"] = *map.width;
        head = io::json_text(json);
    });
    if (ranks.size() == 1) return read;
    ranks.broadcast(head);
    const io::Json json = io::parse_json(head, field.name);
    map.rows = map.columns = json["rows"];
    map.unit = json["unit"];
    map.origin = json["origin"];
    map.notes = json["notes"].get<std::vector<std::string>>();
    map.doubts = json["doubts"].get<std::vector<std::string>>();
    if (json.contains("width")) map.width = json["width"].get<double>();
    read.digest = json["digest"];
    return read;
}

} // namespace asperity
