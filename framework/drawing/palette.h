#pragma once

#include "framework/drawing/vtk.h"

namespace pintle {

/// Colours of bodies in the order of the scene, again from the first after the last: in pictures, frames, the view and the page. The first
/// six are Okabe and Ito's without the yellow, which is invisible on white; with the others, colour-blind people can distinguish them.
inline constexpr std::array<Rgb, 12> body_palette{{{0x00, 0x72, 0xb2},
                                                   {0xd5, 0x5e, 0x00},
                                                   {0x00, 0x9e, 0x73},
                                                   {0xcc, 0x79, 0xa7},
                                                   {0x56, 0xb4, 0xe9},
                                                   {0xe6, 0x9f, 0x00},
                                                   {0x96, 0x1e, 0x1e},
                                                   {0x6a, 0x5c, 0xf0},
                                                   {0x93, 0xa3, 0x4a},
                                                   {0x8a, 0x14, 0x66},
                                                   {0x69, 0x4b, 0x4b},
                                                   {0x2d, 0x69, 0x4b}}};
/// Of arrows, by Giver.
inline constexpr std::array<Rgb, 4> arrow_palette{{{0x5c, 0x61, 0x75}, {0xcc, 0x29, 0x24}, {0x8a, 0x6a, 0x1a}, {0x99, 0x40, 0xbf}}};
inline constexpr std::array<const char*, 4> giver_names{"joint", "contact", "spring", "load"};

/// The scene's, otherwise that of the palette.
inline Rgb body_colour(const Drawing& drawing, std::size_t body) {
  const Rgb& usual = body_palette[body % body_palette.size()];
  return body < drawing.colours.size() ? drawing.colours[body].value_or(usual) : usual;
}

}  // namespace pintle
