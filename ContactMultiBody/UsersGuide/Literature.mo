within ContactMultiBody.UsersGuide;
class Literature "References"
  extends Modelica.Icons.References;
  annotation (DocumentationClass=true, Documentation(info="<html>
<ul>
<li>T. Juh&aacute;sz: Advanced Solutions in Object-Oriented Mechatronic Simulation. Thesis, Budapest University of Technology and Economics, 2008.</li>
<li>K. H. Hunt, F. R. E. Crossley: Coefficient of restitution interpreted as damping in vibroimpact. Journal of Applied Mechanics 42 (1975).</li>
<li>R. G. Herbert, D. C. McWhannell: Shape and frequency composition of pulses from an impact pair. Journal of Engineering for Industry 99 (1977).</li>
<li>T. W. Lee, A. C. Wang: On the dynamics of intermittent-motion mechanisms. Journal of Mechanisms, Transmissions, and Automation in Design 105 (1983).</li>
<li>H. M. Lankarani, P. E. Nikravesh: A contact force model with hysteresis damping for impact analysis of multibody systems. Journal of Mechanical Design 112 (1990).</li>
<li>Y. Gonthier, J. McPhee, C. Lange, J.-C. Piedb&oelig;uf: A regularized contact model with asymmetric damping and dwell-time dependent friction. Multibody System Dynamics 11 (2004).</li>
<li>P. Flores, M. Machado, M. T. Silva, J. M. Martins: On the continuous contact force models for soft materials in multibody dynamics. Multibody System Dynamics 25 (2011).</li>
<li>S. Hu, X. Guo: A dissipative contact force model for impact analysis in multibody dynamics. Multibody System Dynamics 35 (2015).</li>
<li>P. Dupont, V. Hayward, B. Armstrong, F. Altpeter: Single state elastoplastic friction models. IEEE Transactions on Automatic Control 47 (2002).</li>
<li>K. L. Johnson: Contact Mechanics. Cambridge University Press, 1985.</li>
<li>E. A. Avallone, T. Baumeister, A. M. Sadegh (editors): Marks' Standard Handbook for Mechanical Engineers. McGraw-Hill, 2007.</li>
<li>J. M. Gere, B. J. Goodno: Mechanics of Materials. Cengage, 2009.</li>
<li>R. Schneider: Convex Bodies: The Brunn-Minkowski Theory. Cambridge University Press, 2014.</li>
<li>C. Ericson: Real-Time Collision Detection. Morgan Kaufmann, 2005.</li>
</ul>
</html>"));
end Literature;
