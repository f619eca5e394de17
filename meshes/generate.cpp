#include "meshes/generate.h"
