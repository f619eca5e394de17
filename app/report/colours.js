"use strict";

// From dark blue, nothing, over green to yellow, the most: brightness rises evenly, so that it also reads without colour (viridis).
const scaleStops = [[68, 1, 84], [59, 82, 139], [33, 145, 140], [94, 201, 98], [253, 231, 37]];
const scaleSteps = 64;
const scaleColours = Array.from({length: scaleSteps}, (_, step) => {
  const place = (step / (scaleSteps - 1)) * (scaleStops.length - 1);
  const i = Math.min(Math.floor(place), scaleStops.length - 2);
  const mixed = scaleStops[i].map((from, k) => Math.round(from + (place - i) * (scaleStops[i + 1][k] - from)));
  return `rgb(${mixed.join(",")})`;
});

const scaleColour = (share) => scaleColours[Math.min(Math.max(Math.round(share * (scaleSteps - 1)), 0), scaleSteps - 1)];
const scaleGradient = `linear-gradient(to right, ${scaleStops.map((c) => `rgb(${c.join(",")})`).join(", ")})`;

/// Of bodies in the order of the scene, and of arrows: those of framework/drawing/palette.h.
const bodyPalette = [
  "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00", "#961e1e", "#6a5cf0", "#93a34a", "#8a1466", "#694b4b", "#2d694b",
];
const arrowPalette = {joint: "#5c6175", contact: "#cc2924", spring: "#8a6a1a", load: "#9940bf"};

/// Lighter on a dark page.
function onPage(colour) {
  if (!matchMedia("(prefers-color-scheme: dark)").matches) return colour;
  const channels = [1, 3, 5].map((i) => parseInt(colour.slice(i, i + 2), 16));
  return `rgb(${channels.map((c) => Math.round(c + 0.4 * (255 - c))).join(",")})`;
}

/// Colours of the page as it is now, light or dark.
function palette() {
  return {
    ink: css("--ink"),
    faint: css("--faint"),
    line: css("--line"),
    paper: css("--paper"),
    accent: css("--accent"),
    ...Object.fromEntries(Object.entries(arrowPalette).map(([giver, colour]) => [giver, onPage(colour)])),
    bodies: bodyPalette.map(onPage),
  };
}
