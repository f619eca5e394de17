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

/// Lighter on a dark page.
function onPage(colour) {
  if (!matchMedia("(prefers-color-scheme: dark)").matches) return colour;
  return `rgb(${colour.match(/\d+/g).map((c) => Math.round(Number(c) + 0.4 * (255 - c))).join(",")})`;
}

/// Colours of the page as it is now, light or dark, with those of bodies and arrows.
function palette({bodies, givers}) {
  return {
    ink: css("--ink"),
    faint: css("--faint"),
    line: css("--line"),
    paper: css("--paper"),
    accent: css("--accent"),
    ...Object.fromEntries(Object.entries(givers).map(([giver, colour]) => [giver, onPage(colour)])),
    bodies: bodies.map(onPage),
  };
}
