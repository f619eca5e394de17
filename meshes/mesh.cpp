#include "meshes/mesh.h"
