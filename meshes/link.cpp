#include "meshes/link.h"
