// NAFEMS LE1: a quarter between the ellipses x^2/2^2 + y^2 = 1 and x^2/3.25^2 + y^2/2.75^2 = 1.
SetFactory("Built-in");
Point(1) = {0, 0, 0};
Point(2) = {2, 0, 0};    Point(3) = {3.25, 0, 0};
Point(4) = {0, 2.75, 0}; Point(5) = {0, 1, 0};
Line(1) = {2, 3};
Ellipse(2) = {3, 1, 3, 4};
Line(3) = {4, 5};
Ellipse(4) = {5, 1, 2, 2};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Physical Surface("membrane") = {1};
Physical Curve("x axis") = {1};
Physical Curve("outside") = {2};
Physical Curve("y axis") = {3};
Physical Curve("inside") = {4};
