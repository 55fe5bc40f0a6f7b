// SPDX-FileCopyrightText: 2026 The Asperity authors
// SPDX-License-Identifier: MIT
#include "io/png.hpp"

#include "io/error.hpp"

#include <cmath>
#include <memory>

#include <librsvg/rsvg.h>
#include <png.h>

namespace asperity::io {

std::string png_of(std::span<const std::uint8_t> pixels, int width, int height,
                   std::span<const Rgb> palette) {
    png_image image = {};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(width);
    image.height = static_cast<png_uint_32>(height);
    image.format = PNG_FORMAT_RGB_COLORMAP;
    image.colormap_entries = static_cast<png_uint_32>(palette.size());
    png_alloc_size_t size = 0;
    std::string bytes;
    const auto write = [&](void* to) {
        return png_image_write_to_memory(&image, to, &size, 0, pixels.data(), width,
                                         palette.data()) != 0;
    };
    if (pixels.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height) &&
        write(nullptr)) {
        bytes.resize(size);
        if (write(bytes.data())) return bytes;
    }
    const std::string why = image.message;
    png_image_free(&image);
    throw FileError("PNG", "cannot be made", why.empty() ? "the picture has no pixels" : why,
                    "this is a mistake in the program");
}

namespace {

cairo_status_t append(void* to, const unsigned char* data, unsigned length) {
    static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(data), length);
    return CAIRO_STATUS_SUCCESS;
}

[[noreturn]] void cannot_draw(const std::string& why) {
    throw FileError("PNG", "cannot be drawn", why, "the same plot is in the page as SVG");
}

} // namespace

std::string png_of_svg(const std::string& svg, double scale) {
    GError* error = nullptr;
    const std::unique_ptr<RsvgHandle, void (*)(void*)> handle(
        rsvg_handle_new_from_data(reinterpret_cast<const guint8*>(svg.data()), svg.size(), &error),
        [](void* object) { g_object_unref(object); });
    if (!handle) {
        const std::string why = error ? error->message : "librsvg gives no reason";
        g_clear_error(&error);
        cannot_draw(why);
    }
    double width = 0.0, height = 0.0;
    if (!rsvg_handle_get_intrinsic_size_in_pixels(handle.get(), &width, &height))
        cannot_draw("the drawing has no size");
    const std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> surface(
        cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(std::ceil(scale * width)),
                                   static_cast<int>(std::ceil(scale * height))),
        cairo_surface_destroy);
    const std::unique_ptr<cairo_t, void (*)(cairo_t*)> pen(cairo_create(surface.get()),
                                                           cairo_destroy);
    cairo_set_source_rgb(pen.get(), 1.0, 1.0, 1.0);
    cairo_paint(pen.get());
    const RsvgRectangle page = {0.0, 0.0, scale * width, scale * height};
    std::string bytes;
    if (!rsvg_handle_render_document(handle.get(), pen.get(), &page, &error)) {
        const std::string why = error ? error->message : "librsvg gives no reason";
        g_clear_error(&error);
        cannot_draw(why);
    }
    const cairo_status_t done = cairo_surface_write_to_png_stream(surface.get(), append, &bytes);
    if (done != CAIRO_STATUS_SUCCESS) cannot_draw(cairo_status_to_string(done));
    return bytes;
}

std::string base64(const std::string& bytes) {
    constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group =
                group << 8 | (i + k < bytes.size() ? static_cast<std::uint8_t>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            text += k <= bytes.size() - i ? digits[group >> (18 - 6 * k) & 63u] : '=';
    }
    return text;
}

} // namespace asperity::io
