// A quarter of a strip of width 2 with a hole of diameter 1, from its middle to x = 4.
SetFactory("Built-in");
Point(1) = {0, 0, 0};
Point(2) = {0.5, 0, 0}; Point(3) = {4, 0, 0}; Point(4) = {4, 1, 0};
Point(5) = {0, 1, 0};   Point(6) = {0, 0.5, 0};
Line(1) = {2, 3};
Line(2) = {3, 4};
Line(3) = {4, 5};
Line(4) = {5, 6};
Circle(5) = {6, 1, 2};
Curve Loop(1) = {1:5};
Plane Surface(1) = {1};
Physical Surface("strip") = {1};
Physical Curve("x axis") = {1};
Physical Curve("far end") = {2};
Physical Curve("edge") = {3};
Physical Curve("y axis") = {4};
Physical Curve("hole") = {5};
