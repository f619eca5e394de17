#include "elements/section.h"
