#include "elements/plane.h"
