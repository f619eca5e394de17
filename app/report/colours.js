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

/// Colours of the page as it is now, light or dark.
function palette() {
  return {
    ink: css("--ink"),
    faint: css("--faint"),
    line: css("--line"),
    paper: css("--paper"),
    accent: css("--accent"),
    joint: css("--series-0"),
    contact: css("--accent"),
    load: css("--series-3"),
    spring: css("--series-2"),
    bodies: Array.from({length: 8}, (_, i) => css(`--series-${i}`)),
  };
}
