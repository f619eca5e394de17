#pragma once

// What sits the exam of joints. A new one joins by one line in `kinds`.
#include <ostream>

#include "framework/dynamics/model/joints.h"
#include "tests/contracts/moving_bodies.h"

namespace pintle::joint_test {

struct Kind {
  const char* name;
  Joint (*make)(int a, int b, double angle);
};
inline void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.name; }
inline const Kind kinds[] = {
    {"Revolute",
     [](int a, int b, double) {
       return Joint{Revolute{a, b}};
     }},
    {"Slot",
     [](int a, int b, double) {
       return Joint{Slot{a, b}};
     }},
    {"Prismatic",
     [](int a, int b, double angle) {
       return Joint{Prismatic{a, b, angle}};
     }},
    {"Weld",
     [](int a, int b, double angle) {
       return Joint{Weld{a, b, angle}};
     }},
    {"Distance",
     [](int a, int b, double) {
       return Joint{Distance{a, b, 0.8}};
     }},
    {"AngleDriver",
     [](int a, int b, double) {
       return Joint{AngleDriver{a, b, sine}};
     }},
    {"DistanceDriver",
     [](int a, int b, double) {
       return Joint{DistanceDriver{a, b, sine}};
     }},
    {"Gear",
     [](int a, int b, double) {
       return Joint{Gear{a, b, 0.3, 0.5, 0.1}};
     }},
    {"RingGear",
     [](int a, int b, double) {
       return Joint{Gear{a, b, 0.7, -0.3, 0.1}};
     }},
    {"Rack",
     [](int a, int b, double) {
       return Joint{Rack{a, b, -0.3, 0.1}};
     }},
    {"RollsOnDisc",
     [](int a, int b, double) {
       return Joint{RollsOnDisc{{a, b, 0.3, 0.5, 0.1}}};
     }},
    {"RollsInDisc",
     [](int a, int b, double) {
       return Joint{RollsOnDisc{{a, b, 0.9, -0.3, 0.1}}};
     }},
    {"RollsOnLine",
     [](int a, int b, double) {
       return Joint{RollsOnLine{{a, b, -0.3, 0.1}}};
     }},
    {"Differential",
     [](int a, int b, double) {
       return Joint{relation(true, {{a, b, 2}, 3}, {{Coordinate::angle, 2, 0, 1}, {Coordinate::angle, 2, 1, -0.6}})};
     }},
    {"Screw",
     [](int a, int b, double) {
       return Joint{relation(false, {{a, b, 2}, 3}, {{Coordinate::displacement, 2, 1, 1}, {Coordinate::angle, 2, 0, -0.2}})};
     }},
    {"Cam",
     [](int a, int b, double) {
       return Joint{relation(false, {{a, b, 2}, 3}, {{Coordinate::angle, 2, 0, 0}, {Coordinate::displacement, 2, 1, 1}}, sine)};
     }},
    {"CurveOverADistance",
     [](int a, int b, double) {
       return Joint{relation(true, {{a, b, 2}, 3}, {{Coordinate::distance, 0, 1, 0.4}, {Coordinate::angle, 2, 1, 1}}, sine)};
     }},
    {"ThreeTerms",
     [](int a, int b, double) {
       return Joint{relation(false, {{a, b, 2}, 3},
                             {{Coordinate::distance, 0, 1, 0.3}, {Coordinate::displacement, 1, 0, 0.4}, {Coordinate::angle, 2, 1, 1.5}})};
     }},
};

}  // namespace pintle::joint_test
