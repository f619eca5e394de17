#pragma once

/// Members with their names, so that an archive can detect layouts: a(PINTLE_MEMBERS(t, y)).
#define PINTLE_MEMBERS(...) #__VA_ARGS__, __VA_ARGS__
