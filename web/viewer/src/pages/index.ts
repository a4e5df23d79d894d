// The pages, in the order of the tabs.
import type { Pages } from '../shell/opening';
import { asAnyPage } from '../shell/page';
import { discsPage } from './discs/page';
import { nestingPage } from './nesting/page';
import { obstaclePage } from './obstacle/page';
import { solidsPage } from './solids/page';
import { sumPage } from './sum/page';

export const pages: Pages = [asAnyPage(sumPage), asAnyPage(obstaclePage), asAnyPage(solidsPage), asAnyPage(discsPage), asAnyPage(nestingPage)];
