#include "elements/line.h"
