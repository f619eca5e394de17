// A connecting rod drawn by hand, in millimetres. Physical curves name the holes for the scene.
SetFactory("Built-in");
R = 22; r = 13;     // big end: outside, bore
Q = 13; q = 7;      // small end
L = 130;            // between the pins
w = 8; v = 6;       // half the shank's width at the big and the small end

Point(1) = {0, 0, 0, 3};
Point(2) = {L, 0, 0, 2};

// The shank meets the ends at these points.
xb = Sqrt(R*R - w*w);
xs = L - Sqrt(Q*Q - v*v);
Point(11) = {xb, -w, 0, 3};  Point(12) = {xs, -v, 0, 2};
Point(13) = {xs, v, 0, 2};   Point(14) = {xb, w, 0, 3};
Point(15) = {0, R, 0, 3};    Point(16) = {-R, 0, 0, 3};  Point(17) = {0, -R, 0, 3};
Point(18) = {L, -Q, 0, 2};   Point(19) = {L + Q, 0, 0, 2}; Point(20) = {L, Q, 0, 2};

Line(1) = {11, 12};
Circle(2) = {12, 2, 18}; Circle(3) = {18, 2, 19}; Circle(4) = {19, 2, 20}; Circle(5) = {20, 2, 13};
Line(6) = {13, 14};
Circle(7) = {14, 1, 15}; Circle(8) = {15, 1, 16}; Circle(9) = {16, 1, 17}; Circle(10) = {17, 1, 11};
Curve Loop(1) = {1:10};

Point(21) = {r, 0, 0, 2}; Point(22) = {0, r, 0, 2}; Point(23) = {-r, 0, 0, 2}; Point(24) = {0, -r, 0, 2};
Circle(21) = {21, 1, 22}; Circle(22) = {22, 1, 23}; Circle(23) = {23, 1, 24}; Circle(24) = {24, 1, 21};
Curve Loop(2) = {21:24};

Point(31) = {L + q, 0, 0, 1.5}; Point(32) = {L, q, 0, 1.5}; Point(33) = {L - q, 0, 0, 1.5}; Point(34) = {L, -q, 0, 1.5};
Circle(31) = {31, 2, 32}; Circle(32) = {32, 2, 33}; Circle(33) = {33, 2, 34}; Circle(34) = {34, 2, 31};
Curve Loop(3) = {31:34};

Plane Surface(1) = {1, 2, 3};
Physical Surface("rod") = {1};
Physical Curve("big end") = {21:24};
Physical Curve("small end") = {31:34};
Physical Curve("outline") = {1:10};
