#include "meshes/inp.h"
