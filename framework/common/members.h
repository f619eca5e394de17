#pragma once

/// Members with their names, for an archive to tell layouts apart: a(PINTLE_MEMBERS(t, y)).
#define PINTLE_MEMBERS(...) #__VA_ARGS__, __VA_ARGS__
