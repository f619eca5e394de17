// A plate 0.12 m by 0.04 m with two holes of radius 0.01 m; only the left one has a name.
Point(1) = {0, -0.02, 0};
Point(2) = {0.12, -0.02, 0};
Point(3) = {0.12, 0.02, 0};
Point(4) = {0, 0.02, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1:4};
For h In {0:1}
  x = 0.02 + 0.08 * h;
  p = newp;
  Point(p) = {x, 0, 0};
  Point(p + 1) = {x + 0.01, 0, 0};
  Point(p + 2) = {x, 0.01, 0};
  Point(p + 3) = {x - 0.01, 0, 0};
  Point(p + 4) = {x, -0.01, 0};
  c = 10 + 10 * h;
  Circle(c) = {p + 1, p, p + 2};
  Circle(c + 1) = {p + 2, p, p + 3};
  Circle(c + 2) = {p + 3, p, p + 4};
  Circle(c + 3) = {p + 4, p, p + 1};
  Curve Loop(2 + h) = {c:c + 3};
EndFor
Plane Surface(1) = {1, 2, 3};
Physical Curve("pin hole") = {10:13};
Physical Curve("left edge") = {4};
Physical Point("corner") = {3};
Physical Surface("steel") = {1};
