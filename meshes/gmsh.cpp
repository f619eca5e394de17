#include "meshes/gmsh.h"
