#include "elements/point_mass.h"
