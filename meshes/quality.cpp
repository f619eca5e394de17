#include "meshes/quality.h"
